// The spatial filters of FLIP, by rows and columns.
#include "FlipFilter.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>

#include "FlipColor.h"
#include "LanternCore/Tasks/Tasks.h"

namespace Lantern
{

namespace
{

constexpr double Pi = std::numbers::pi;

/// a · sqrt(π / b) · exp(−π² x² / b), x in degrees: the contrast sensitivity function's Fourier transform.
struct FSensitivity
{
	double A = 0.0;
	double B = 0.0;
};
constexpr FSensitivity AchromaticSensitivity = {1.0, 0.0047};
constexpr FSensitivity RedGreenSensitivity = {1.0, 0.0053};
constexpr FSensitivity BlueYellowSensitivity[2] = {{34.1, 0.04}, {13.5, 0.025}};
constexpr double WidestB = 0.04;

/// Width of a feature in degrees.
constexpr double FeatureWidth = 0.082;

/// Planes between the horizontal and the vertical pass.
enum EPlane
{
	PlaneAchromatic,
	PlaneRedGreen,
	PlaneBlueYellow0,
	PlaneBlueYellow1,
	PlaneGaussian,
	PlaneEdge,
	PlanePoint,
	PlaneCount,
};
static_assert(PlaneCount == std::extent_v<decltype(FFlipScratch::Planes)>);

double Sum(const std::vector<double>& Weights)
{
	double Total = 0.0;
	for (const double Weight : Weights) { Total += Weight; }
	return Total;
}

std::vector<double> MakeBell(const FSensitivity& Sensitivity, int Radius, double PixelsPerDegree)
{
	std::vector<double> Weights;
	for (int Offset = -Radius; Offset <= Radius; ++Offset)
	{
		const double Degrees = Offset / PixelsPerDegree;
		Weights.push_back(std::exp(-Pi * Pi * Degrees * Degrees / Sensitivity.B));
	}
	return Weights;
}

/// To float, without the tails that could not change a float sum: the narrow bells get half the taps.
FFlipKernel Finish(const std::vector<double>& Weights, double Scale)
{
	const size_t Centre = Weights.size() / 2;
	size_t Radius = Centre;
	while (Radius > 0 && Weights[Centre + Radius] < 1e-9 * Weights[Centre]) { --Radius; }
	FFlipKernel Kernel;
	for (size_t Index = Centre - Radius; Index <= Centre + Radius; ++Index)
	{
		Kernel.push_back(static_cast<float>(Weights[Index] * Scale));
	}
	return Kernel;
}

/// Positive weights made to sum to 1 and negative ones to −1, so that the strongest step or line gives 1.
FFlipKernel FinishDerivative(const std::vector<double>& Weights)
{
	double Positive = 0.0;
	double Negative = 0.0;
	for (const double Weight : Weights) { (Weight > 0.0 ? Positive : Negative) += Weight; }
	FFlipKernel Kernel;
	for (const double Weight : Weights) { Kernel.push_back(static_cast<float>(Weight > 0.0 ? Weight / Positive : Weight / -Negative)); }
	return Kernel;
}

void MakeFeatureKernels(double PixelsPerDegree, FFlipKernels& OutKernels)
{
	const double Deviation = 0.5 * FeatureWidth * PixelsPerDegree;
	const int Radius = static_cast<int>(std::ceil(3.0 * Deviation));
	std::vector<double> Gaussian, Edge, Point;
	for (int Offset = -Radius; Offset <= Radius; ++Offset)
	{
		const double Scaled = Offset / Deviation;
		const double Bell = std::exp(-0.5 * Scaled * Scaled);
		Gaussian.push_back(Bell);
		Edge.push_back(-Scaled * Bell);
		Point.push_back((Scaled * Scaled - 1.0) * Bell);
	}
	const double Total = Sum(Gaussian);
	for (const double Weight : Gaussian) { OutKernels.Gaussian.push_back(static_cast<float>(Weight / Total)); }
	OutKernels.Edge = FinishDerivative(Edge);
	OutKernels.Point = FinishDerivative(Point);
}

size_t GetRadius(const FFlipKernel& Kernel) { return Kernel.size() / 2; }

/// One channel of a row with its ends repeated, so that the inner loop needs no test.
class FPaddedRow
{
public:
	FPaddedRow(size_t InCount, size_t InPadding) : Count(InCount), Padding(InPadding), Values(InCount + 2 * InPadding) {}
	float& operator[](size_t X) { return Values[Padding + X]; }
	void RepeatEnds()
	{
		std::fill_n(Values.begin(), Padding, Values[Padding]);
		std::fill_n(Values.end() - static_cast<ptrdiff_t>(Padding), Padding, Values[Padding + Count - 1]);
	}
	void Convolve(const FFlipKernel& Kernel, float* Out) const
	{
		const float* Source = Values.data() + Padding - GetRadius(Kernel);
		std::fill_n(Out, Count, 0.0f);
		for (size_t Tap = 0; Tap < Kernel.size(); ++Tap)
		{
			const float Weight = Kernel[Tap];
			for (size_t X = 0; X < Count; ++X) { Out[X] += Weight * Source[X + Tap]; }
		}
	}

private:
	size_t Count;
	size_t Padding;
	std::vector<float> Values;
};

void FilterRows(const FImage& Image, const FFlipKernels& Kernels, FFlipScratch& Scratch, size_t Begin, size_t End)
{
	const size_t Width = Image.Width;
	const size_t Padding = std::max(GetRadius(Kernels.BlueYellow[0]), GetRadius(Kernels.Gaussian));
	FPaddedRow Achromatic(Width, Padding), RedGreen(Width, Padding), BlueYellow(Width, Padding), Grey(Width, Padding);
	for (size_t Y = Begin; Y < End; ++Y)
	{
		const float* Pixel = &Image.Pixels[Y * Width * 3];
		for (size_t X = 0; X < Width; ++X, Pixel += 3)
		{
			const FColor3 Opponent = LinearToYCxCz({Pixel[0], Pixel[1], Pixel[2]});
			Achromatic[X] = Opponent.X;
			RedGreen[X] = Opponent.Y;
			BlueYellow[X] = Opponent.Z;
			Grey[X] = (Opponent.X + 16.0f) / 116.0f;
		}
		Achromatic.RepeatEnds();
		RedGreen.RepeatEnds();
		BlueYellow.RepeatEnds();
		Grey.RepeatEnds();
		const auto Row = [&](EPlane Plane) { return &Scratch.Planes[Plane][Y * Width]; };
		Achromatic.Convolve(Kernels.Achromatic, Row(PlaneAchromatic));
		RedGreen.Convolve(Kernels.RedGreen, Row(PlaneRedGreen));
		BlueYellow.Convolve(Kernels.BlueYellow[0], Row(PlaneBlueYellow0));
		BlueYellow.Convolve(Kernels.BlueYellow[1], Row(PlaneBlueYellow1));
		Grey.Convolve(Kernels.Gaussian, Row(PlaneGaussian));
		Grey.Convolve(Kernels.Edge, Row(PlaneEdge));
		Grey.Convolve(Kernels.Point, Row(PlanePoint));
	}
}

/// Adds the column convolution of one plane at row Y to Out.
void AddColumns(const std::vector<float>& Plane, size_t Width, size_t Height, size_t Y, const FFlipKernel& Kernel, std::vector<float>& Out)
{
	const ptrdiff_t Radius = static_cast<ptrdiff_t>(GetRadius(Kernel));
	for (ptrdiff_t Tap = -Radius; Tap <= Radius; ++Tap)
	{
		const ptrdiff_t Row = std::clamp(static_cast<ptrdiff_t>(Y) + Tap, ptrdiff_t(0), static_cast<ptrdiff_t>(Height) - 1);
		const float Weight = Kernel[static_cast<size_t>(Tap + Radius)];
		const float* Source = &Plane[static_cast<size_t>(Row) * Width];
		for (size_t X = 0; X < Width; ++X) { Out[X] += Weight * Source[X]; }
	}
}

float GetLength(float X, float Y) { return std::sqrt(X * X + Y * Y); }

void FilterColumns(
    const FFlipScratch& Scratch, const FFlipKernels& Kernels, size_t Width, size_t Height, size_t Begin, size_t End, FFlipView& OutView)
{
	enum
	{
		Achromatic,
		RedGreen,
		BlueYellow,
		EdgeX,
		EdgeY,
		PointX,
		PointY,
		SumCount
	};
	std::vector<float> Sums[SumCount];
	for (size_t Y = Begin; Y < End; ++Y)
	{
		for (std::vector<float>& Row : Sums) { Row.assign(Width, 0.0f); }
		const auto Add = [&](EPlane Plane, const FFlipKernel& Kernel, int Target) {
			AddColumns(Scratch.Planes[Plane], Width, Height, Y, Kernel, Sums[Target]);
		};
		Add(PlaneAchromatic, Kernels.Achromatic, Achromatic);
		Add(PlaneRedGreen, Kernels.RedGreen, RedGreen);
		Add(PlaneBlueYellow0, Kernels.BlueYellow[0], BlueYellow);
		Add(PlaneBlueYellow1, Kernels.BlueYellow[1], BlueYellow);
		Add(PlaneEdge, Kernels.Gaussian, EdgeX);
		Add(PlaneGaussian, Kernels.Edge, EdgeY);
		Add(PlanePoint, Kernels.Gaussian, PointX);
		Add(PlaneGaussian, Kernels.Point, PointY);
		for (size_t X = 0; X < Width; ++X)
		{
			const FColor3 Lab = LinearToHuntLab(YCxCzToLinear({Sums[Achromatic][X], Sums[RedGreen][X], Sums[BlueYellow][X]}));
			const size_t Pixel = Y * Width + X;
			OutView.Lab[0][Pixel] = Lab.X;
			OutView.Lab[1][Pixel] = Lab.Y;
			OutView.Lab[2][Pixel] = Lab.Z;
			OutView.Edge[Pixel] = GetLength(Sums[EdgeX][X], Sums[EdgeY][X]);
			OutView.Point[Pixel] = GetLength(Sums[PointX][X], Sums[PointY][X]);
		}
	}
}

} // namespace

FFlipKernels MakeFlipKernels(float PixelsPerDegree)
{
	const double Ppd = static_cast<double>(PixelsPerDegree);
	const int Radius = static_cast<int>(std::ceil(3.0 * std::sqrt(WidestB / (2.0 * Pi * Pi)) * Ppd));
	const auto MakeNormalised = [&](const FSensitivity& Sensitivity) {
		const std::vector<double> Weights = MakeBell(Sensitivity, Radius, Ppd);
		return Finish(Weights, 1.0 / Sum(Weights));
	};
	FFlipKernels Kernels;
	Kernels.Achromatic = MakeNormalised(AchromaticSensitivity);
	Kernels.RedGreen = MakeNormalised(RedGreenSensitivity);

	// The sum of the two bells is normalised as a whole, in two dimensions.
	std::vector<double> Bells[2];
	double Amplitudes[2] = {};
	double Total = 0.0;
	for (int Index = 0; Index < 2; ++Index)
	{
		const FSensitivity& Sensitivity = BlueYellowSensitivity[Index];
		Bells[Index] = MakeBell(Sensitivity, Radius, Ppd);
		Amplitudes[Index] = Sensitivity.A * std::sqrt(Pi / Sensitivity.B);
		Total += Amplitudes[Index] * Sum(Bells[Index]) * Sum(Bells[Index]);
	}
	for (int Index = 0; Index < 2; ++Index) { Kernels.BlueYellow[Index] = Finish(Bells[Index], std::sqrt(Amplitudes[Index] / Total)); }
	MakeFeatureKernels(Ppd, Kernels);
	return Kernels;
}

void FilterForFlip(const FImage& LinearRgb, const FFlipKernels& Kernels, FFlipScratch& Scratch, FFlipView& OutView)
{
	constexpr size_t RowGrain = 8;
	const size_t PixelCount = LinearRgb.GetPixelCount();
	for (std::vector<float>& Plane : Scratch.Planes) { Plane.resize(PixelCount); }
	for (std::vector<float>* Plane : {&OutView.Lab[0], &OutView.Lab[1], &OutView.Lab[2], &OutView.Edge, &OutView.Point})
	{
		Plane->resize(PixelCount);
	}
	ParallelFor(LinearRgb.Height, RowGrain, [&](size_t Begin, size_t End) { FilterRows(LinearRgb, Kernels, Scratch, Begin, End); });
	ParallelFor(LinearRgb.Height, RowGrain,
	    [&](size_t Begin, size_t End) { FilterColumns(Scratch, Kernels, LinearRgb.Width, LinearRgb.Height, Begin, End, OutView); });
}

} // namespace Lantern
