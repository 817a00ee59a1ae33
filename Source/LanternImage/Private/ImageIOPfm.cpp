// Reads and writes PFM files.
#include <bit>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <system_error>

#include "ImageCodecs.h"
#include "LanternImage/AtomicFile.h"

namespace Lantern
{

namespace
{

struct FCloseFile
{
	void operator()(std::FILE* File) const { std::fclose(File); }
};
using FFilePointer = std::unique_ptr<std::FILE, FCloseFile>;

struct FPfmHeader
{
	uint32_t Width = 0;
	uint32_t Height = 0;
	uint32_t Channels = 0;
	bool bLittleEndian = true;
};

constexpr size_t LongestToken = 31;

bool IsSpace(int Character) { return Character == ' ' || Character == '\n' || Character == '\r' || Character == '\t'; }

/// Next word of the header and the one white-space character after it; empty where there is none.
std::string ReadToken(std::FILE* File)
{
	int Character = std::fgetc(File);
	while (IsSpace(Character)) { Character = std::fgetc(File); }
	std::string Token;
	while (Character != EOF && !IsSpace(Character) && Token.size() < LongestToken)
	{
		Token.push_back(static_cast<char>(Character));
		Character = std::fgetc(File);
	}
	// Some writers end lines with CR LF; a lone CR belongs to the pixels no more than any other white space.
	if (Character == '\r')
	{
		const int Next = std::fgetc(File);
		if (Next != '\n' && Next != EOF) { std::ungetc(Next, File); }
	}
	return IsSpace(Character) ? Token : std::string();
}

template <class T>
bool ParseNumber(const std::string& Token, T& OutValue)
{
	const char* End = Token.data() + Token.size();
	const std::from_chars_result Result = std::from_chars(Token.data(), End, OutValue);
	return !Token.empty() && Result.ec == std::errc() && Result.ptr == End;
}

FRTStatus ReadHeader(const std::string& Path, std::FILE* File, FPfmHeader& OutHeader)
{
	const std::string Magic = ReadToken(File);
	if (Magic != "PF" && Magic != "Pf")
	{
		return MakeFileError(ERTResult::IoError, Path, "is not a PFM file (it must start with PF or Pf)");
	}
	OutHeader.Channels = Magic == "PF" ? 3 : 1;

	const std::string Width = ReadToken(File);
	const std::string Height = ReadToken(File);
	int64_t Sizes[2] = {};
	if (!ParseNumber(Width, Sizes[0]) || !ParseNumber(Height, Sizes[1]))
	{
		return MakeFileError(ERTResult::IoError, Path, "its PFM header lacks a width and a height");
	}
	if (Sizes[0] < 0 || Sizes[1] < 0 || !IsImageSizeValid(static_cast<uint64_t>(Sizes[0]), static_cast<uint64_t>(Sizes[1])))
	{
		return MakeSizeError(Path, Width, Height);
	}
	OutHeader.Width = static_cast<uint32_t>(Sizes[0]);
	OutHeader.Height = static_cast<uint32_t>(Sizes[1]);

	double Scale = 0.0;
	if (!ParseNumber(ReadToken(File), Scale) || !std::isfinite(Scale) || Scale == 0.0)
	{
		return MakeFileError(ERTResult::IoError, Path, "the scale in its PFM header is not a number other than 0");
	}
	OutHeader.bLittleEndian = Scale < 0.0;
	return FRTStatus::Success();
}

uint32_t SwapBytes(uint32_t Value) { return (Value >> 24) | ((Value >> 8) & 0xFF00u) | ((Value << 8) & 0xFF0000u) | (Value << 24); }

void ToNativeOrder(float* Values, size_t Count, bool bLittleEndian)
{
	if (bLittleEndian == (std::endian::native == std::endian::little)) { return; }
	for (size_t Index = 0; Index < Count; ++Index)
	{
		Values[Index] = std::bit_cast<float>(SwapBytes(std::bit_cast<uint32_t>(Values[Index])));
	}
}

} // namespace

FRTStatus ReadPfm(const std::string& Path, FImage& OutImage)
{
	const FFilePointer File(std::fopen(Path.c_str(), "rb"));
	if (!File) { return MakeFileError(ERTResult::IoError, Path, "cannot be read: " + std::generic_category().message(errno)); }
	FPfmHeader Header;
	if (FRTStatus Status = ReadHeader(Path, File.get(), Header); !Status) { return Status; }

	// Before any memory is taken: a header of a few bytes may ask for gigabytes.
	const uint64_t Needed = uint64_t(Header.Width) * Header.Height * Header.Channels * sizeof(float);
	const uint64_t Present = std::filesystem::file_size(Path) - static_cast<uint64_t>(std::ftell(File.get()));
	if (Present < Needed)
	{
		return MakeFileError(ERTResult::IoError, Path,
		    "ends early: " + std::to_string(Needed) + " bytes of pixels needed, " + std::to_string(Present) + " present");
	}

	OutImage = FImage(Header.Width, Header.Height, Header.Channels);
	const size_t RowValues = size_t(Header.Width) * Header.Channels;
	for (uint32_t Row = 0; Row < Header.Height; ++Row)
	{
		float* Values = &OutImage.Pixels[(Header.Height - 1 - Row) * RowValues];
		if (std::fread(Values, sizeof(float), RowValues, File.get()) != RowValues)
		{
			return MakeFileError(ERTResult::IoError, Path, "cannot be read to its end");
		}
		ToNativeOrder(Values, RowValues, Header.bLittleEndian);
	}
	return FRTStatus::Success();
}

FRTStatus WritePfm(const std::string& Path, const std::string& Temporary, const FImage& Image)
{
	FFilePointer File(std::fopen(Temporary.c_str(), "wb"));
	if (!File) { return MakeFileError(ERTResult::IoError, Path, "cannot be written: " + std::generic_category().message(errno)); }
	const uint32_t Channels = Image.GetColorChannels();
	const size_t RowValues = size_t(Image.Width) * Channels;
	bool bWritten = std::fprintf(File.get(), "%s\n%u %u\n-1.0\n", Channels == 3 ? "PF" : "Pf", Image.Width, Image.Height) > 0;
	std::vector<float> Row(RowValues);
	for (uint32_t Y = Image.Height; Y-- > 0 && bWritten;)
	{
		for (uint32_t X = 0; X < Image.Width; ++X)
		{
			std::memcpy(
			    &Row[size_t(X) * Channels], &Image.Pixels[(size_t(Y) * Image.Width + X) * Image.Channels], Channels * sizeof(float));
		}
		ToNativeOrder(Row.data(), RowValues, true);
		bWritten = std::fwrite(Row.data(), sizeof(float), RowValues, File.get()) == RowValues;
	}
	int Error = errno;
	if (std::fclose(File.release()) != 0 && bWritten)
	{
		bWritten = false;
		Error = errno;
	}
	return bWritten ? FRTStatus::Success()
	                : MakeFileError(ERTResult::IoError, Path, "cannot be written: " + std::generic_category().message(Error));
}

} // namespace Lantern
