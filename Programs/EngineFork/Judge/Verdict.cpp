// Compares shadow mask and ambient occlusion with what they must be.
#include "Judge/Verdict.h"

#include <cmath>
#include <cstdio>

#include <glm/gtc/packing.hpp>

namespace Fork
{

namespace
{

float GetRight(EExpectation Expected) { return Expected == EExpectation::Shadowed ? 0.0f : 1.0f; }
bool IsWrong(EExpectation Expected, float Found) { return Expected != EExpectation::Unsure && Found != GetRight(Expected); }

} // namespace

FShadowPicture ExpectShadow(const FForkScene& Scene, const FCamera& Camera, ELightSource Source)
{
	FShadowPicture Picture;
	const FShadowTruth Truth(Scene, Camera);
	for (uint32_t Y = 0; Y < ViewSize.height; ++Y)
	{
		for (uint32_t X = 0; X < ViewSize.width; ++X)
		{
			Picture.push_back(Truth.ExpectPixel(X, Y, ViewSize.width, ViewSize.height, Source));
		}
	}
	return Picture;
}

FVerdict JudgeShadow(const FShadowPicture& Expectations, const uint16_t* Mask)
{
	FVerdict Verdict;
	for (uint32_t Pixel = 0; Pixel < PixelCount; ++Pixel)
	{
		const EExpectation Expected = Expectations[Pixel].Shadow;
		Verdict.Wrong += IsWrong(Expected, glm::unpackHalf1x16(Mask[Pixel]));
		Verdict.Unsure += Expected == EExpectation::Unsure;
		Verdict.Sky += Expected == EExpectation::Sky;
		Verdict.Lit += Expected == EExpectation::Lit;
		Verdict.Shadowed += Expected == EExpectation::Shadowed;
	}
	return Verdict;
}

FError JudgeLight(const FShadowPicture& Expectations, const FFrameMasks& Masks, const FShadowPicture* Lamp)
{
	constexpr double Step = 0.008; // of the 8 bits of each of the normal's coordinates
	for (uint32_t Pixel = 0; Pixel < PixelCount; ++Pixel)
	{
		const FExpectedPixel& Expected = Expectations[Pixel];
		const FExpectedPixel OfLamp = Lamp != nullptr ? (*Lamp)[Pixel] : FExpectedPixel{};
		if (Expected.Shadow == EExpectation::Unsure || OfLamp.Shadow == EExpectation::Unsure) { continue; }
		const auto Read = [&](const uint16_t* Mask) { return Mask != nullptr ? double(glm::unpackHalf1x16(Mask[Pixel])) : 1.0; };
		const double Light = FForkLight::Sun * Expected.Light * Read(Masks.SunShadow) + FForkLight::Ambient * Read(Masks.AmbientOcclusion) +
		                     (OfLamp.Shadow == EExpectation::Lit ? OfLamp.Light : 0.0);
		const double Right = Expected.Shadow == EExpectation::Sky ? 0.0 : FForkRaster::Grey * Light;
		const double Found = glm::unpackHalf1x16(Masks.Lit[Pixel * 4]);
		if (!(std::abs(Found - Right) < Step))
		{
			return "pixel " + std::to_string(Pixel % ViewSize.width) + ", " + std::to_string(Pixel / ViewSize.width) + " is lit by " +
			       std::to_string(Found) + ", not by " + std::to_string(Right);
		}
	}
	return {};
}

std::vector<float> ReadMask(const uint16_t* Mask)
{
	std::vector<float> Values;
	for (uint32_t Pixel = 0; Pixel < PixelCount; ++Pixel) { Values.push_back(glm::unpackHalf1x16(Mask[Pixel])); }
	return Values;
}

double Compare(const std::vector<float>& A, const std::vector<float>& B)
{
	double Sum = 0.0;
	for (size_t Index = 0; Index < A.size(); ++Index) { Sum += std::abs(double(A[Index]) - double(B[Index])); }
	return Sum / double(A.size());
}

double GetMeanLight(const FFrameMasks& Masks)
{
	double Sum = 0.0, Count = 0.0;
	for (uint32_t Pixel = 0; Pixel < PixelCount; ++Pixel)
	{
		if (glm::unpackHalf1x16(Masks.Lit[Pixel * 4 + 3]) < 0.5f) { continue; }
		Sum += glm::unpackHalf1x16(Masks.Lit[Pixel * 4]);
		Count += 1.0;
	}
	return Sum / Count;
}

FError JudgeOcclusion(const uint16_t* Visibility)
{
	uint32_t Open = 0;
	for (uint32_t Pixel = 0; Pixel < PixelCount; ++Pixel)
	{
		const float Found = glm::unpackHalf1x16(Visibility[Pixel]);
		if (!(Found >= 0.0f && Found <= 1.01f)) { return "ambient occlusion is " + std::to_string(Found) + " somewhere"; }
		Open += Found > 0.95f;
	}
	const uint32_t Occluded = PixelCount - Open;
	std::printf("ambient occlusion: %u open, %u occluded\n", Open, Occluded);
	return Open > PixelCount / 2 && Occluded > PixelCount / 500 ? FError() : "ambient occlusion is not where it must be";
}

FError WritePicture(const std::string& Path, const FShadowPicture& Expectations, const uint16_t* Mask)
{
	std::FILE* File = std::fopen(Path.c_str(), "wb");
	if (File == nullptr) { return Path + " cannot be written"; }
	std::fprintf(File, "P6\n%u %u\n255\n", ViewSize.width, ViewSize.height);
	for (uint32_t Pixel = 0; Pixel < PixelCount; ++Pixel)
	{
		const float Found = glm::unpackHalf1x16(Mask[Pixel]);
		const EExpectation Expected = Expectations[Pixel].Shadow;
		const int Shade = static_cast<int>(Found * 160.0f + 0.5f);
		const bool bWrong = IsWrong(Expected, Found);
		std::fputc(bWrong && GetRight(Expected) > 0.5f ? 255 : Shade, File);
		std::fputc(bWrong && GetRight(Expected) < 0.5f ? 255 : Shade, File);
		std::fputc(Expected == EExpectation::Unsure ? Shade + 80 : Shade, File);
	}
	return std::fclose(File) == 0 ? FError() : Path + " cannot be written";
}

} // namespace Fork
