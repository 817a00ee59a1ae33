// Images: found and measured one after the other, decoded in parallel.
#include <map>
#include <mutex>

#include <fmt/format.h>

#include "Gltf/GltfDocument.h"
#include "Gltf/StbDecode.h"
#include "LanternCore/Tasks/Tasks.h"
#include "LanternCore/Text/Quote.h"

namespace Lantern::Gltf
{

namespace
{

struct FEncodedImage
{
	FBlob Blob;
	size_t HostImage = 0;
	std::string Place; ///< "images[2] 'bark.png' (materials[0].normalTexture)"
	std::string Error;
};

FBlob ReadImageBytes(const FDocument& Document, const FJson& Json)
{
	FBlob Blob;
	const FJson Uri = Json.Member("uri");
	const int32_t View = Json.GetIndex("bufferView", Document.BufferViews.size(), "buffer view");
	if (Uri.Exists() == (View >= 0)) { Json.Fail("needs either a 'uri' or a 'bufferView'"); }
	if (View >= 0) { Blob.Bytes = Document.BufferViews[View]; }
	else if (IsDataUri(Uri.ToString())) { Blob.Own(DecodeDataUri(Uri, Uri.ToString())); }
	else
	{
		const std::filesystem::path Path = ResolveUri(Uri, Uri.ToString(), Document.Folder);
		try
		{
			Blob.Own(ReadFile(Path, INT32_MAX));
		}
		catch (const FError& Error)
		{
			throw FError(fmt::format("'{}' {}", EscapePath(Path.string()), Error.what()));
		}
	}
	return Blob;
}

/// Reads the header and charges the decoded size, before any of it is allocated.
void Measure(const FDocument& Document, const FEncodedImage& Encoded, uint64_t& InOutBytes)
{
	uint32_t Width = 0, Height = 0;
	if (!GetImageSize(Encoded.Blob.Bytes, Width, Height)) { throw FError("not a PNG or JPEG image"); }
	if (Width > Document.Options.MaxImageSize || Height > Document.Options.MaxImageSize)
	{
		throw FError(fmt::format("{}×{} texels; the limit is {}²", Width, Height, Document.Options.MaxImageSize));
	}
	InOutBytes += uint64_t(Width) * Height * 4;
	if (InOutBytes > Document.Options.MaxImageBytes)
	{
		throw FError(fmt::format("the images unfold to more than the limit of {} bytes", Document.Options.MaxImageBytes));
	}
	FHostImage& Image = Document.Scene.Images[Encoded.HostImage];
	Image.Width = Width;
	Image.Height = Height;
}

/// Fills OutEncoded with one entry per file; OutSame says which host image is a copy of which other.
void Collect(FDocument& Document, std::vector<FEncodedImage>& OutEncoded, std::map<size_t, size_t>& OutSame)
{
	const FJson Images = Document.Root.Member("images");
	std::map<std::string, size_t> FirstByName;
	uint64_t Bytes = 0;
	for (size_t I = 0; I < Document.ImageSources.size(); ++I)
	{
		const FDocument::FImageSource& Source = Document.ImageSources[I];
		const FJson Json = Images.Element(Source.GltfImage);
		const FJson Uri = Json.Member("uri");
		const bool bFile = Uri.Exists() && !IsDataUri(Uri.ToString());
		const std::string Key = bFile ? Uri.ToString() : fmt::format("[{}]", Source.GltfImage);
		const auto [First, bNew] = FirstByName.try_emplace(Key, I);
		FEncodedImage Encoded;
		Encoded.HostImage = bNew ? I : First->second;
		Encoded.Place = fmt::format("images[{}] {} ({})", Source.GltfImage, Quote(Document.Scene.Images[I].Name), Source.UsedBy);
		try
		{
			if (bNew)
			{
				Encoded.Blob = ReadImageBytes(Document, Json);
				Measure(Document, Encoded, Bytes);
				OutEncoded.push_back(std::move(Encoded));
			}
			else
			{
				OutSame[I] = First->second;
				const FHostImage& Original = Document.Scene.Images[First->second];
				Bytes += uint64_t(Original.Width) * Original.Height * 4;
			}
		}
		catch (const FError& Error)
		{
			throw FError(fmt::format("{}: {}", Encoded.Place, Error.what()));
		}
	}
}

} // namespace

void ReadImages(FDocument& Document)
{
	std::vector<FEncodedImage> Encoded;
	std::map<size_t, size_t> Same;
	Collect(Document, Encoded, Same);

	std::mutex ProgressMutex;
	size_t Done = 0;
	ParallelFor(Encoded.size(), 1, [&](size_t Begin, size_t End) {
		for (size_t I = Begin; I < End; ++I)
		{
			FHostImage& Image = Document.Scene.Images[Encoded[I].HostImage];
			try
			{
				Encoded[I].Error = DecodeImage(Encoded[I].Blob.Bytes, Image.Rgba, Image.bHasAlpha);
				if (Encoded[I].Error.empty() && Image.Rgba.size() != size_t(Image.Width) * Image.Height * 4)
				{
					Encoded[I].Error = "its size changes between header and pixels";
				}
			}
			catch (const std::bad_alloc&)
			{
				Encoded[I].Error = "out of memory";
			}
			Encoded[I].Blob = {};
			const std::lock_guard Lock(ProgressMutex);
			Document.ReportProgress("images", float(++Done) / float(Encoded.size()));
		}
	});
	for (const FEncodedImage& Image : Encoded)
	{
		if (!Image.Error.empty()) { throw FError(fmt::format("{}: cannot be decoded: {}", Image.Place, Image.Error)); }
	}
	for (const auto& [Copy, Original] : Same)
	{
		const FHostImage& From = Document.Scene.Images[Original];
		FHostImage& To = Document.Scene.Images[Copy];
		To.Width = From.Width;
		To.Height = From.Height;
		To.bHasAlpha = From.bHasAlpha;
		To.Rgba = From.Rgba;
	}
}

} // namespace Lantern::Gltf
