// Reads files, the GLB container and data URIs.
#include "Gltf/GltfFile.h"

#include <array>
#include <cstring>
#include <fstream>

#include <fmt/format.h>

#include "LanternCore/Text/Quote.h"

namespace Lantern::Gltf
{

std::vector<uint8_t> ReadFile(const std::filesystem::path& Path, uint64_t MaxBytes)
{
	std::error_code Error;
	const auto Status = std::filesystem::status(Path, Error);
	if (!std::filesystem::exists(Status)) { throw FError("no such file"); }
	if (std::filesystem::is_directory(Status)) { throw FError("is a directory"); }
	if (!std::filesystem::is_regular_file(Status)) { throw FError("is not a regular file"); }
	const uint64_t Size = std::filesystem::file_size(Path, Error);
	std::ifstream Stream(Path, std::ios::binary);
	if (Error || !Stream) { throw FError(fmt::format("cannot be read: {}", std::strerror(errno))); }
	if (Size > MaxBytes) { throw FError(fmt::format("has {} bytes, more than the limit of {}", Size, MaxBytes)); }
	std::vector<uint8_t> Data(Size);
	Stream.read(reinterpret_cast<char*>(Data.data()), std::streamsize(Size));
	if (uint64_t(Stream.gcount()) != Size) { throw FError(fmt::format("only {} of {} bytes could be read", Stream.gcount(), Size)); }
	return Data;
}

namespace
{

constexpr uint32_t GlbMagic = 0x46546C67;       // "glTF"
constexpr uint32_t GlbJsonChunk = 0x4E4F534A;   // "JSON"
constexpr uint32_t GlbBinaryChunk = 0x004E4942; // "BIN"

uint32_t ReadU32(FBytes Data, size_t Offset)
{
	return uint32_t(Data[Offset]) | uint32_t(Data[Offset + 1]) << 8 | uint32_t(Data[Offset + 2]) << 16 | uint32_t(Data[Offset + 3]) << 24;
}

} // namespace

bool IsGlb(FBytes Data) { return Data.size() >= 4 && ReadU32(Data, 0) == GlbMagic; }

FGlb SplitGlb(FBytes Data)
{
	if (Data.size() < 20) { throw FError(fmt::format("GLB of {} bytes is shorter than its header", Data.size())); }
	const uint32_t Version = ReadU32(Data, 4);
	const uint64_t Length = ReadU32(Data, 8);
	if (Version != 2) { throw FError(fmt::format("GLB version {} is not supported (2 is)", Version)); }
	if (Length > Data.size()) { throw FError(fmt::format("GLB is truncated: {} bytes declared, {} there", Length, Data.size())); }
	FGlb Glb;
	uint64_t Offset = 12;
	for (int Chunk = 0; Offset + 8 <= Length; ++Chunk)
	{
		const uint64_t ChunkLength = ReadU32(Data, Offset);
		const uint32_t ChunkType = ReadU32(Data, Offset + 4);
		Offset += 8;
		if (ChunkLength > Length - Offset)
		{
			throw FError(fmt::format("GLB chunk {}: {} bytes declared, {} left in the file", Chunk, ChunkLength, Length - Offset));
		}
		const FBytes Body = Data.subspan(Offset, ChunkLength);
		if (Chunk == 0)
		{
			if (ChunkType != GlbJsonChunk) { throw FError("the first chunk of the GLB is not JSON"); }
			Glb.Json = {reinterpret_cast<const char*>(Body.data()), Body.size()};
		}
		else if (Chunk == 1 && ChunkType == GlbBinaryChunk) { Glb.Binary = Body; }
		Offset += (ChunkLength + 3) & ~uint64_t(3);
	}
	if (Glb.Json.empty()) { throw FError("GLB without a JSON chunk"); }
	return Glb;
}

bool IsDataUri(std::string_view Uri) { return Uri.substr(0, 5) == "data:"; }

std::vector<uint8_t> DecodeDataUri(const FJson& Place, std::string_view Uri)
{
	constexpr std::string_view Marker = ";base64,";
	const size_t Start = Uri.substr(0, 256).find(Marker);
	if (Start == std::string_view::npos) { Place.Fail("data URI without ';base64,'"); }
	static const auto Table = [] {
		std::array<int8_t, 256> Values;
		Values.fill(-1);
		constexpr std::string_view Alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
		for (size_t I = 0; I < Alphabet.size(); ++I) { Values[uint8_t(Alphabet[I])] = int8_t(I); }
		return Values;
	}();
	std::string_view Text = Uri.substr(Start + Marker.size());
	while (!Text.empty() && Text.back() == '=') { Text.remove_suffix(1); }
	std::vector<uint8_t> Data;
	Data.reserve(Text.size() / 4 * 3 + 3);
	uint32_t Bits = 0;
	int BitCount = 0;
	for (size_t I = 0; I < Text.size(); ++I)
	{
		const int8_t Value = Table[uint8_t(Text[I])];
		if (Value < 0) { Place.Fail(fmt::format("data URI: character {} of the base64 text is not base64", I)); }
		Bits = Bits << 6 | uint32_t(Value);
		BitCount += 6;
		if (BitCount >= 8)
		{
			BitCount -= 8;
			Data.push_back(uint8_t(Bits >> BitCount));
		}
	}
	return Data;
}

namespace
{

std::string PercentDecode(const FJson& Place, std::string_view Uri)
{
	const auto HexDigit = [](char C) -> int {
		if (C >= '0' && C <= '9') { return C - '0'; }
		const char Lower = char(C | 0x20);
		return Lower >= 'a' && Lower <= 'f' ? Lower - 'a' + 10 : -1;
	};
	std::string Text;
	for (size_t I = 0; I < Uri.size(); ++I)
	{
		char C = Uri[I];
		if (C == '%' && I + 2 < Uri.size() && HexDigit(Uri[I + 1]) >= 0 && HexDigit(Uri[I + 2]) >= 0)
		{
			C = char(HexDigit(Uri[I + 1]) * 16 + HexDigit(Uri[I + 2]));
			I += 2;
		}
		if (C == '\0') { Place.Fail("URI holds a zero byte"); }
		Text += C;
	}
	return Text;
}

} // namespace

std::filesystem::path ResolveUri(const FJson& Place, std::string_view Uri, const std::filesystem::path& Folder)
{
	const std::string Text = PercentDecode(Place, Uri);
	if (Folder.empty()) { Place.Fail(fmt::format("external file {} refused: the asset is in memory", Quote(Text))); }
	if (Text.empty()) { Place.Fail("URI is empty"); }
	const std::filesystem::path Path(Text);
	if (Text.find(':') != std::string::npos || Text.find('\\') != std::string::npos || Path.is_absolute())
	{
		Place.Fail(fmt::format("URI {} refused: only files beside the asset are read", Quote(Text)));
	}
	const std::filesystem::path Normal = Path.lexically_normal();
	if (Normal.empty() || *Normal.begin() == "..") { Place.Fail(fmt::format("URI {} refused: it leaves the asset's folder", Quote(Text))); }
	return Folder / Normal;
}

} // namespace Lantern::Gltf
