// The file format of cached signal references.
#include "SignalReferenceFile.h"

#include <cmath>
#include <cstring>
#include <fstream>

#include "LanternCore/Text/Log.h"
#include "LanternCore/Text/Quote.h"
#include "LanternImage/AtomicFile.h"

namespace Lantern
{

namespace
{
/// Little-endian, as every machine that this runs on. The checksum is over all that is behind it.
struct FHeader
{
	char Magic[8] = {'L', 'N', 'T', 'S', 'I', 'G', '0', '1'};
	uint64_t Checksum[2] = {};
	uint64_t Key[2] = {};
	double Seconds = 0.0;
	uint32_t Width = 0, Height = 0, Channels = 0, Pad = 0;
};
static_assert(sizeof(FHeader) == 64, "no padding: it is written as bytes");

void SetChecksum(FHeader& Header, const FImage& A, const FImage& B)
{
	FContentHasher Hash;
	constexpr size_t Skipped = offsetof(FHeader, Key);
	Hash.AddBytes(reinterpret_cast<const char*>(&Header) + Skipped, sizeof(Header) - Skipped);
	Hash.AddBytes(A.Pixels.data(), A.Pixels.size() * sizeof(float));
	Hash.AddBytes(B.Pixels.data(), B.Pixels.size() * sizeof(float));
	const FContentHash Sum = Hash.Finish();
	Header.Checksum[0] = Sum.Low;
	Header.Checksum[1] = Sum.High;
}

FHeader MakeHeader(const FContentHash& Key, const FReferenceFileShape& Shape, double Seconds)
{
	FHeader Header;
	Header.Key[0] = Key.Low;
	Header.Key[1] = Key.High;
	Header.Seconds = Seconds;
	Header.Width = Shape.Width;
	Header.Height = Shape.Height;
	Header.Channels = Shape.Channels;
	return Header;
}

void WritePixels(std::ofstream& File, const FImage& Image)
{
	File.write(reinterpret_cast<const char*>(Image.Pixels.data()), static_cast<std::streamsize>(Image.Pixels.size() * sizeof(float)));
}

bool ReadPixels(std::ifstream& File, const FReferenceFileShape& Shape, FImage& Out)
{
	Out = FImage(Shape.Width, Shape.Height, Shape.Channels);
	File.read(reinterpret_cast<char*>(Out.Pixels.data()), static_cast<std::streamsize>(Out.Pixels.size() * sizeof(float)));
	return static_cast<bool>(File);
}

/// What is wrong with it; null: nothing.
const char* Parse(std::ifstream& File, const FContentHash& Key, const FReferenceFileShape& Shape, FSignalReference& Out)
{
	FHeader Header;
	File.read(reinterpret_cast<char*>(&Header), sizeof(Header));
	if (!File) { return "is cut off"; }
	if (std::memcmp(Header.Magic, FHeader().Magic, sizeof(Header.Magic)) != 0) { return "is no reference of this version"; }
	const FHeader Wanted = MakeHeader(Key, Shape, Header.Seconds);
	constexpr size_t Start = offsetof(FHeader, Key);
	if (std::memcmp(reinterpret_cast<char*>(&Header) + Start, reinterpret_cast<const char*>(&Wanted) + Start, sizeof(Header) - Start) != 0)
	{
		return "holds another reference than its name says";
	}
	if (!ReadPixels(File, Shape, Out.A) || !ReadPixels(File, Shape, Out.B)) { return "is cut off"; }
	if (File.peek() != std::ifstream::traits_type::eof()) { return "is longer than it should be"; }
	FHeader Summed = Header;
	SetChecksum(Summed, Out.A, Out.B);
	if (std::memcmp(Summed.Checksum, Header.Checksum, sizeof(Header.Checksum)) != 0) { return "is damaged"; }
	Out.Seconds = Header.Seconds;
	return nullptr;
}
} // namespace

FRTStatus WriteReferenceFile(const std::string& Path, const FContentHash& Key, const FSignalReference& Reference)
{
	const FImage& A = Reference.A;
	FHeader Header = MakeHeader(Key, {A.Width, A.Height, A.Channels}, Reference.Seconds);
	SetChecksum(Header, A, Reference.B);
	return WriteFileAtomically(Path, [&](const std::string& Temporary) {
		std::ofstream File(Temporary, std::ios::binary);
		File.write(reinterpret_cast<const char*>(&Header), sizeof(Header));
		WritePixels(File, A);
		WritePixels(File, Reference.B);
		File.close();
		return File ? FRTStatus::Success() : MakeFileError(ERTResult::IoError, Path, "cannot be written");
	});
}

bool ReadReferenceFile(const std::string& Path, const FContentHash& Key, const FReferenceFileShape& Shape, FSignalReference& Out)
{
	std::ifstream File(Path, std::ios::binary);
	if (!File) { return false; }
	const char* const Fault = Parse(File, Key, Shape, Out);
	if (!Fault) { return true; }
	LogWarning("{} {}: it is traced anew", EscapePath(Path), Fault);
	Out = {};
	return false;
}

} // namespace Lantern
