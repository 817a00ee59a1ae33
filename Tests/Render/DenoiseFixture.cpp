#include "DenoiseFixture.h"

#include <cmath>

namespace Lantern
{

std::vector<FImage> FDenoiseTest::RenderSequence(const FSequence& Sequence)
{
	std::vector<FImage> Images;
	GetEngine().SetFrameIndex(Sequence.FirstIndex);
	for (uint32_t Frame = 0; Frame < Sequence.Frames; ++Frame)
	{
		if (Sequence.Change) { Sequence.Change(Frame); }
		FView View = Sequence.Camera(Frame);
		View.bCut = Frame == 0;
		FFrameCapture Capture;
		Capture.Signals.Add(ESignal::SunShadow);
		FCapturedFrame Captured;
		EXPECT_OK(GetEngine().RenderFrame(View, Sequence.Time(Frame), Capture, &Captured));
		FImage& Image = Captured.Get(ESignal::SunShadow);
		EXPECT_EQ(Image.Width, View.Width) << "the frame has no sun shadows";
		Images.push_back(Image.Width == View.Width ? std::move(Image) : FImage(View.Width, View.Height, 1));
	}
	return Images;
}

FImage FDenoiseTest::RenderTruth(const FView& View, uint32_t Count, double Time)
{
	UseRays(64);
	FSequence Sequence;
	Sequence.Camera = [&](uint32_t) { return View; };
	Sequence.Time = [&](uint32_t) { return Time; };
	Sequence.Frames = Count;
	FImage Mean(View.Width, View.Height, 1);
	for (const FImage& Image : RenderSequence(Sequence))
	{
		for (size_t I = 0; I < Mean.Pixels.size(); ++I) { Mean.Pixels[I] += Image.Pixels[I] / float(Count); }
	}
	return Mean;
}

void FDenoiseTest::UseFilter()
{
	SetVariable("r.RT.Shadow.Samples", "1");
	SetVariable("r.RT.Shadow.Denoise", "1");
}

void FDenoiseTest::UseRays(uint32_t Rays)
{
	SetVariable("r.RT.Shadow.Samples", std::to_string(Rays));
	SetVariable("r.RT.Shadow.Denoise", "0");
}

FView FDenoiseTest::Move(FView View, double Right, double Forward, double TurnDegrees)
{
	const glm::dvec3 Ahead = glm::normalize(glm::dvec3(View.Forward));
	const glm::dvec3 Aside = glm::normalize(glm::cross(Ahead, glm::dvec3(View.Up)));
	View.Position += Aside * Right + Ahead * Forward;
	const double Angle = glm::radians(TurnDegrees);
	View.Forward = glm::vec3(Ahead * std::cos(Angle) + Aside * std::sin(Angle));
	return View;
}

namespace
{
double MeanOver(const FImage& A, const FImage& B, const std::vector<uint8_t>& Mask, double (*Error)(double, double))
{
	EXPECT_EQ(A.Pixels.size(), B.Pixels.size());
	double Sum = 0.0;
	size_t Count = 0;
	for (size_t I = 0; I < std::min(A.Pixels.size(), B.Pixels.size()); ++I)
	{
		if (!Mask.empty() && Mask[I] == 0) { continue; }
		Sum += Error(A.Pixels[I], B.Pixels[I]);
		++Count;
	}
	EXPECT_GT(Count, 0u);
	return Sum / double(std::max<size_t>(Count, 1));
}
} // namespace

double ComputeRelMse(const FImage& A, const FImage& B, const std::vector<uint8_t>& Mask)
{
	return MeanOver(A, B, Mask, [](double X, double Y) { return (X - Y) * (X - Y) / (Y * Y + 0.01); });
}

double ComputeMeanSquare(const FImage& A, const FImage& B, const std::vector<uint8_t>& Mask)
{
	return MeanOver(A, B, Mask, [](double X, double Y) { return (X - Y) * (X - Y); });
}

} // namespace Lantern
