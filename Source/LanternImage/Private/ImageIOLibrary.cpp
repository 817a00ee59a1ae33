// The only file that knows OpenImageIO.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>

#include "ImageCodecs.h"
#include "LanternImage/AtomicFile.h"

namespace Lantern
{

namespace
{

/// Name within its layer, in capitals: "diffuse.r" gives "R".
std::string GetShortName(const std::string& Channel)
{
	std::string Name = Channel.substr(Channel.find_last_of('.') + 1);
	std::transform(
	    Name.begin(), Name.end(), Name.begin(), [](unsigned char Character) { return static_cast<char>(std::toupper(Character)); });
	return Name;
}

/// Neighbouring channels to read; Count 0: none that make a picture.
struct FChannelRange
{
	int First = 0;
	int Count = 0;
};

FChannelRange FindColorChannels(const OIIO::ImageSpec& Spec)
{
	std::vector<std::string> Names;
	for (const std::string& Channel : Spec.channelnames) { Names.push_back(GetShortName(Channel)); }
	Names.resize(static_cast<size_t>(Spec.nchannels));
	const auto Find = [&](const std::vector<std::string>& Wanted) {
		const auto Position = std::search(Names.begin(), Names.end(), Wanted.begin(), Wanted.end());
		return Position == Names.end() ? -1 : static_cast<int>(Position - Names.begin());
	};
	// Luminance with subsampled chroma would read as a grey image.
	if (Find({"RY"}) >= 0) { return {}; }
	static const std::vector<std::string> Known[] = {{"R", "G", "B", "A"}, {"R", "G", "B"}, {"Y", "A"}, {"Y"}};
	for (const std::vector<std::string>& Wanted : Known)
	{
		if (const int First = Find(Wanted); First >= 0) { return {First, static_cast<int>(Wanted.size())}; }
	}
	return Spec.nchannels <= 4 ? FChannelRange{0, Spec.nchannels} : FChannelRange{};
}

std::string GetLibraryError(const std::string& Message)
{
	// The library's own messages may run over several lines.
	std::string Line = Message.empty() ? "the image library gives no reason" : Message;
	std::replace(Line.begin(), Line.end(), '\n', ' ');
	return Line;
}

FRTStatus CheckSpec(const std::string& Path, const OIIO::ImageSpec& Spec)
{
	if (Spec.width < 0 || Spec.height < 0 || !IsImageSizeValid(static_cast<uint64_t>(Spec.width), static_cast<uint64_t>(Spec.height)))
	{
		return MakeSizeError(Path, std::to_string(Spec.width), std::to_string(Spec.height));
	}
	if (Spec.deep || Spec.depth > 1) { return MakeFileError(ERTResult::Unsupported, Path, "is a deep or volume image"); }
	return FRTStatus::Success();
}

OIIO::ImageSpec MakeSpec(const FImage& Image, OIIO::TypeDesc Type)
{
	OIIO::ImageSpec Spec(static_cast<int>(Image.Width), static_cast<int>(Image.Height), static_cast<int>(Image.Channels), Type);
	const bool bGrey = Image.GetColorChannels() == 1;
	Spec.channelnames = bGrey ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "G", "B"};
	if (Image.Channels % 2 == 0)
	{
		Spec.channelnames.push_back("A");
		Spec.alpha_channel = static_cast<int>(Image.Channels) - 1;
	}
	Spec.attribute("oiio:UnassociatedAlpha", 1);
	return Spec;
}

std::vector<uint8_t> Quantise(const FImage& Image)
{
	std::vector<uint8_t> Bytes(Image.Pixels.size());
	std::transform(Image.Pixels.begin(), Image.Pixels.end(), Bytes.begin(), [](float Value) {
		// The comparison sends NaN to 0.
		return Value > 0.0f ? static_cast<uint8_t>(std::lround(std::min(Value, 1.0f) * 255.0f)) : uint8_t(0);
	});
	return Bytes;
}

} // namespace

bool IsImageLibraryPresent() { return true; }

FRTStatus ReadWithLibrary(const std::string& Path, FImage& OutImage)
{
	OIIO::ImageSpec Config;
	Config.attribute("oiio:UnassociatedAlpha", 1);
	const auto Input = OIIO::ImageInput::open(Path, &Config);
	if (!Input) { return MakeFileError(ERTResult::IoError, Path, "cannot be read: " + GetLibraryError(OIIO::geterror())); }
	const OIIO::ImageSpec Spec = Input->spec();
	if (FRTStatus Status = CheckSpec(Path, Spec); !Status) { return Status; }
	const FChannelRange Range = FindColorChannels(Spec);
	if (Range.Count == 0)
	{
		return MakeFileError(
		    ERTResult::Unsupported, Path, std::to_string(Spec.nchannels) + " channels, and none that make R, G, B or Y alone");
	}
	const EImageSpace Space = Spec.format.is_floating_point() ? EImageSpace::Linear : EImageSpace::Display;
	OutImage = FImage(static_cast<uint32_t>(Spec.width), static_cast<uint32_t>(Spec.height), static_cast<uint32_t>(Range.Count), Space);
	if (!Input->read_image(0, 0, Range.First, Range.First + Range.Count, OIIO::TypeFloat, OutImage.Pixels.data()))
	{
		return MakeFileError(ERTResult::IoError, Path, "is damaged: " + GetLibraryError(Input->geterror()));
	}
	return FRTStatus::Success();
}

FRTStatus WriteWithLibrary(const std::string& Path, const std::string& Temporary, EImageFile Format, const FImage& Image)
{
	const bool bPng = Format == EImageFile::Png;
	// By format, not by name: the temporary file's ending says nothing.
	const auto Output = OIIO::ImageOutput::create(bPng ? "png" : "openexr");
	if (!Output) { return MakeFileError(ERTResult::Unsupported, Path, GetLibraryError(OIIO::geterror())); }
	OIIO::ImageSpec Spec = MakeSpec(Image, bPng ? OIIO::TypeUInt8 : OIIO::TypeFloat);
	if (!bPng) { Spec.attribute("compression", "zip"); }
	const std::vector<uint8_t> Bytes = bPng ? Quantise(Image) : std::vector<uint8_t>();
	const void* Data = bPng ? static_cast<const void*>(Bytes.data()) : Image.Pixels.data();
	if (!Output->open(Temporary, Spec) || !Output->write_image(Spec.format, Data) || !Output->close())
	{
		return MakeFileError(ERTResult::IoError, Path, "cannot be written: " + GetLibraryError(Output->geterror()));
	}
	return FRTStatus::Success();
}

} // namespace Lantern
