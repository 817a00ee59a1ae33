// Cases about what must never show: 14 not a number, 20 seams, 24 far from the origin, 25 single-sided planes, 27 sizes.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternImage/ImageStatistics.h"
#include "LanternMeasure/Stability/StabilityStage.h"
#include "Stability/StabilityFigures.h"
#include "Stability/StabilityGeometry.h"

namespace Lantern
{

namespace
{
/// Plays a scene full of what divides by zero and overflows. bPoison: what frames keep becomes not-a-number in between.
FRTStatus PlayHostileScene(FStabilityStage& Stage, size_t Count, size_t Poisoned, size_t Again, bool bPoison, std::vector<FImage>& Out)
{
	if (FRTStatus S = Stage.Load("stability-nan"); !S) { return S; }
	std::vector<FStabilityShot> Shots(Count);
	for (size_t I = 0; I < Count; ++I)
	{
		Shots[I].View = Stage.MakeView({0.004 * double(std::min<size_t>(I, 6)), 1.5, 4}, {0, 0.5, 0}, 50);
		Shots[I].bKeep = true;
		// All; then only what is kept of signals, which what is kept of surfaces cannot vouch against.
		if (bPoison) { Shots[I].Poison = I == Poisoned ? "*" : I == Again ? "History" : ""; }
	}
	return Stage.Play(Shots, Out);
}
} // namespace

/// Pixels that are not finite: in any frame of a scene full of what divides by zero and overflows, in the frames
/// whose histories are not-a-number, and later. Then how far off the mean is 32 frames after (the
/// first, radiance cells lack further bounces) against frames without injection. The
/// fault for methods that keep something: their guard is off. Else one pixel of a frame is overwritten, which tries no more than the
/// counting.
FRTStatus MeasureNotANumber(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out)
{
	constexpr size_t Poisoned = 12, Again = 15, Count = 56;
	std::vector<FImage> Clean, Frames;
	if (FRTStatus S = PlayHostileScene(Stage, Count, Poisoned, Again, false, Clean); !S) { return S; }
	if (FRTStatus S = PlayHostileScene(Stage, Count, Poisoned, Again, true, Frames); !S) { return S; }
	if (Stage.IsFaulty())
	{
		Frames[4].Pixels[0] = Frames[Poisoned].Pixels[0] = Frames[Poisoned + 2].Pixels[0] = std::numeric_limits<float>::quiet_NaN();
	}
	const auto CountIn = [&](size_t First, size_t Last) {
		uint64_t Sum = 0;
		for (size_t I = First; I < Last; ++I) { Sum += CountNonFinitePixels(Frames[I]); }
		return double(Sum);
	};
	for (const size_t I : {Poisoned - 1, Poisoned, Poisoned + 1, Count - 1}) { Stage.AddToStrip(Frames[I], {}); }
	// A guard that is off does nothing as long as there is nothing to guard against.
	Out.push_back({"pixels before injection", CountIn(0, Poisoned),
	    Stage.IsBroken() && !Stage.IsFaulty() ? std::nullopt : std::optional<double>(0.0)});
	Out.push_back({"pixels in its frames", CountIn(Poisoned, Poisoned + 1) + CountIn(Again, Again + 1), 0.0});
	Out.push_back({"pixels later", CountIn(Poisoned + 1, Again) + CountIn(Again + 1, Count), 0.0});
	const FImage Without = MeanImage({Clean.end() - 8, Clean.end()}), After = MeanImage({Frames.end() - 8, Frames.end()});
	Out.push_back({"mean, off by", std::abs(MeanOver(After) / MeanOver(Without) - 1.0),
	    Stage.IsBroken() ? std::nullopt : std::optional<double>(0.05)});
	return FRTStatus::Success();
}

namespace
{
/// Over the columns whose number is a multiple of Tile against all others, of a value per column.
double CompareColumns(const std::vector<double>& Columns, uint32_t Tile, bool bRatio)
{
	double At = 0.0, Else = 0.0;
	int AtCount = 0, ElseCount = 0;
	for (uint32_t X = 1; X < Columns.size(); ++X)
	{
		(X % Tile == 0 ? At : Else) += Columns[X];
		++(X % Tile == 0 ? AtCount : ElseCount);
	}
	At /= std::max(1, AtCount);
	Else /= std::max(1, ElseCount);
	return bRatio ? At / std::max(Else, 1e-9) : std::max(0.0, At - Else);
}
} // namespace

namespace
{
std::vector<double> GetColumnMeans(const FImage& Image)
{
	std::vector<double> Means(Image.Width);
	for (uint32_t Y = 0; Y < Image.Height; ++Y)
	{
		for (uint32_t X = 0; X < Image.Width; ++X) { Means[X] += double(GetLuminance(Image, X, Y)) / Image.Height; }
	}
	return Means;
}

FImage GetDeviation(const std::vector<FImage>& Frames, const FImage& Mean)
{
	FImage Deviation(Mean.Width, Mean.Height, Mean.Channels);
	for (size_t I = 0; I < Mean.Pixels.size(); ++I)
	{
		double Squares = 0.0;
		for (const FImage& Frame : Frames)
		{
			Squares += (double(Frame.Pixels[I]) - double(Mean.Pixels[I])) * (double(Frame.Pixels[I]) - double(Mean.Pixels[I]));
		}
		Deviation.Pixels[I] = static_cast<float>(std::sqrt(Squares / double(Frames.size() - 1)));
	}
	return Deviation;
}
} // namespace

namespace
{
/// By how much pixels of one colour of a checkerboard, which changes with each frame, stand out from those around them more than pixels
/// of the other do, over the mean: at borders of shadows, where there is something to stand out from.
double CompareCheckers(const std::vector<FImage>& Frames)
{
	double Steps[2] = {}, Sum = 0.0;
	uint64_t Count = 0;
	for (size_t F = 0; F < Frames.size(); ++F)
	{
		const FImage& Frame = Frames[F];
		const double Mean = MeanOver(Frame);
		const auto At = [&](uint32_t X, uint32_t Y) { return double(GetLuminance(Frame, X, Y)); };
		for (uint32_t Y = 1; Y + 1 < Frame.Height; ++Y)
		{
			for (uint32_t X = 1; X + 1 < Frame.Width; ++X)
			{
				const double Around = 0.25 * (At(X - 1, Y) + At(X + 1, Y) + At(X, Y - 1) + At(X, Y + 1));
				double Low = At(X, Y), High = Low;
				for (uint32_t I = 0; I < 9; ++I)
				{
					Low = std::min(Low, At(X + I % 3 - 1, Y + I / 3 - 1));
					High = std::max(High, At(X + I % 3 - 1, Y + I / 3 - 1));
				}
				if (High - Low < 0.2 * Mean) { continue; }
				Steps[(X + Y + F) % 2] += std::abs(At(X, Y) - Around);
				Sum += Around;
				++Count;
			}
		}
	}
	return 2.0 * std::abs(Steps[0] - Steps[1]) / Sum * (Count > 0 ? 1.0 : 0.0);
}
} // namespace

/// Steps of the mean picture, and temporal σ, at the borders of tiles of 8 and 16 pixels against all other columns, while the camera
/// moves over a smooth scene. Of lamps: and what stands out in every other pixel, in turn. The fault: every other tile is
/// brighter; where every other pixel asks for rays, none asks for second ones.
FRTStatus MeasureSeams(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out)
{
	const bool bLamps = Stage.GetSignal() == ESignal::LocalDiffuse;
	if (FRTStatus S = Stage.Load(bLamps ? "stability-seams:4" : "stability-seams"); !S) { return S; }
	constexpr size_t Count = 48, Warm = 16;
	std::vector<FStabilityShot> Shots(Count);
	for (size_t I = 0; I < Count; ++I)
	{
		Shots[I].View = Stage.MakeView({0.01 * double(I), 3, 1.5}, {0.01 * double(I), 0, -1}, 70);
		Shots[I].bKeep = I >= Warm;
	}
	std::vector<FImage> Frames;
	if (FRTStatus S = Stage.Play(Shots, Frames); !S) { return S; }
	Frames.erase(Frames.begin(), Frames.begin() + Warm);
	const uint32_t Width = Frames[0].Width, Height = Frames[0].Height;
	for (size_t F = 0; Stage.IsFaulty() && F < Frames.size(); ++F)
	{
		for (uint32_t Pixel = 0; Pixel < Width * Height; ++Pixel)
		{
			for (uint32_t C = 0; C < Frames[F].Channels && (Pixel % Width / 8) % 2; ++C)
			{
				Frames[F].Pixels[Pixel * Frames[F].Channels + C] *= F % 2 ? 1.3f : 1.1f;
			}
		}
	}
	const FImage Mean = MeanImage(Frames);
	Stage.AddToStrip(Frames.back(), {});
	Stage.AddToStrip(Mean, {});
	const std::vector<double> Columns = GetColumnMeans(Mean);
	std::vector<double> Steps(Width), Sigmas = GetColumnMeans(GetDeviation(Frames, Mean));
	// By how much a step is larger than those beside it: what is smooth has none.
	for (uint32_t X = 2; X + 1 < Width; ++X)
	{
		const double Beside = 0.5 * (Columns[X - 1] - Columns[X - 2] + Columns[X + 1] - Columns[X]);
		Steps[X] = std::abs(Columns[X] - Columns[X - 1] - Beside) / MeanOver(Mean);
	}
	double WorstStep = 0.0, WorstSigma = 0.0;
	for (const uint32_t Tile : {8u, 16u})
	{
		WorstStep = std::max(WorstStep, CompareColumns(Steps, Tile, false));
		WorstSigma = std::max(WorstSigma, CompareColumns(Sigmas, Tile, true));
	}
	// Without second rays, tiles are as good as they were.
	const bool bNoSecondRays = Stage.IsBroken() && !Stage.IsFaulty();
	Out.push_back({"step at tile borders", WorstStep, bNoSecondRays ? std::nullopt : std::optional<double>(0.02)});
	// Fault: a brighter tile flickers as a whole, its border no more than the rest.
	Out.push_back({"sigma at tile borders", WorstSigma, Stage.IsBroken() ? std::nullopt : std::optional<double>(1.5)});
	if (bLamps)
	{
		Out.push_back({"step at checkers", CompareCheckers(Frames), Stage.IsFaulty() ? std::nullopt : std::optional<double>(0.02)});
	}
	return FRTStatus::Success();
}

/// The same pictures of the same room, at the origin and far from it, half a step of the scene's origin away from where that
/// may be: means of 32 frames compared in blocks of 4 × 4, and
/// pixels that are off by more than a tenth of the mean, as acne is. The fault: far away, the camera is where a world of
/// 1/16 m steps has it.
FRTStatus MeasureFarAway(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out)
{
	std::vector<FImage> Means;
	for (const double Far : {0.0, 1.0 - 0.5 * FRTScene::OriginStep / 16'000.0})
	{
		if (FRTStatus S = Stage.Load(fmt::format("stability-far:{}", Far)); !S) { return S; }
		std::vector<FStabilityShot> Shots(32);
		for (size_t I = 0; I < Shots.size(); ++I)
		{
			FView& View = Shots[I].View = Stage.MakeView();
			View.Position.x += 0.01 * double(I / 4);
			if (Far > 0.0 && Stage.IsFaulty()) { View.Position = glm::round(View.Position * 16.0) / 16.0; }
			Shots[I].bKeep = true;
		}
		std::vector<FImage> Frames;
		if (FRTStatus S = Stage.Play(Shots, Frames); !S) { return S; }
		Means.push_back(MeanImage(Frames));
		Stage.AddToStrip(Means.back(), {});
	}
	const std::vector<double> Near = ComputeBlockMeans(Means[0], 4), Away = ComputeBlockMeans(Means[1], 4);
	double Difference = 0.0, Sum = 0.0;
	for (size_t I = 0; I < Near.size(); ++I)
	{
		Difference += std::abs(Away[I] - Near[I]);
		Sum += Near[I];
	}
	const double Mean = Sum / double(Near.size());
	uint64_t Off = 0;
	for (uint32_t Pixel = 0; Pixel < Means[0].GetPixelCount(); ++Pixel)
	{
		const uint32_t X = Pixel % Means[0].Width, Y = Pixel / Means[0].Width;
		Off += std::abs(double(GetLuminance(Means[1], X, Y)) - double(GetLuminance(Means[0], X, Y))) > 0.1 * Mean ? 1 : 0;
	}
	Out.push_back({"difference", Difference / Sum, 1e-3});
	Out.push_back({"pixels off", double(Off) / double(Means[0].GetPixelCount()), 1e-3});
	return FRTStatus::Success();
}

/// Planes that face up, down, or both ways, against shadows cast by the CPU, which knows no faces: part of the floor that is
/// on the wrong side of ½, penumbrae left out. The fault: faces turned towards the sun are culled.
FRTStatus MeasurePlanes(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out)
{
	if (FRTStatus S = Stage.Load("planes"); !S) { return S; }
	const FView View = Stage.MakeView();
	std::vector<FImage> Frames;
	if (FRTStatus S = Stage.Play(RepeatView(View, 8, 0), Frames); !S) { return S; }
	const FImage Mean = MeanImage(Frames);
	const FSceneDescription& Scene = Stage.GetScene().GetDescription();
	const FCpuScene Cpu(Scene, 0.0);
	const glm::dvec3 ToSun = -glm::normalize(Stage.GetScene().GetScene().GetSun().Direction);
	const glm::dvec3 Side = glm::normalize(glm::cross(ToSun, glm::dvec3(0, 0, 1))), Up = glm::cross(Side, ToSun);
	const auto Hits = TracePicture(Cpu, View);
	FImage Expected(View.Width, View.Height, 1);
	uint64_t Wrong = 0, All = 0, Dark = 0;
	for (size_t Pixel = 0; Pixel < Hits.size(); ++Pixel)
	{
		if (!Hits[Pixel] || Scene.Nodes[static_cast<size_t>(Hits[Pixel]->Node)].Name != "floor") { continue; }
		int Blocked = 0;
		constexpr int Directions = 9;
		for (int I = 0; I < Directions; ++I)
		{
			// Wider than the sun by a pixel's footprint.
			const double Angle = 0.785398 * I, Radius = I ? 0.03 : 0.0;
			const glm::dvec3 To = glm::normalize(ToSun + Radius * (std::cos(Angle) * Side + std::sin(Angle) * Up));
			Blocked += Cpu.Trace(Hits[Pixel]->Position + 1e-4 * To, To) ? 1 : 0;
		}
		Expected.Pixels[Pixel] = 1.0f - float(Blocked) / Directions;
		if (Blocked > 0 && Blocked < Directions) { continue; }
		++All;
		Dark += Blocked ? 1 : 0;
		Wrong += (Mean.Pixels[Pixel] < 0.5f) != (Blocked > 0) ? 1 : 0;
	}
	Stage.AddToStrip(Mean, Expected);
	if (Dark < 100) { return FRTStatus::Error(ERTResult::InvalidArgument, "planes: the picture shows no shadows"); }
	Out.push_back({"pixels on the wrong side", double(Wrong) / double(All), 1e-3});
	return FRTStatus::Success();
}

namespace
{
/// What every pixel of "stability-flat" has.
double GetFlatValue(FStabilityStage& Stage)
{
	const FSunLight& Sun = Stage.GetScene().GetScene().GetSun();
	const double Cosine = -glm::normalize(Sun.Direction).y;
	return Stage.GetSignal() == ESignal::Frame ? 0.5 * (double(Sun.Irradiance) * Cosine / 3.14159265358979 + 1.0) : 1.0;
}

/// Share of its value by which a pixel may be off. Rough specular lobes are lit by paths that another lobe has drawn, so that they have
/// noise under a sky of one value, and their albedo is a fit within 2.3 %. What is not written is off by all.
double GetFlatTolerance(ESignal Signal) { return Signal == ESignal::RoughSpecular ? 0.5 : 0.02; }

FRTStatus CountWrongPixels(FStabilityStage& Stage, uint32_t Width, uint32_t Height, uint64_t& OutWrong)
{
	std::vector<FStabilityShot> Shots(4);
	for (FStabilityShot& Shot : Shots)
	{
		Shot.View = Stage.MakeView();
		Shot.View.Width = Width;
		Shot.View.Height = Height;
		// So that the widest picture sees no horizon.
		Shot.View.FovY = static_cast<float>(2.0 * std::atan(0.4 * std::min(1.0, double(Height) / Width)));
		Shot.bKeep = true;
	}
	std::vector<FImage> Frames;
	if (FRTStatus S = Stage.Play(Shots, Frames); !S) { return S; }
	const double Value = GetFlatValue(Stage), Tolerance = GetFlatTolerance(Stage.GetSignal());
	for (FImage& Frame : Frames)
	{
		if (Frame.Width != Width || Frame.Height != Height)
		{
			return FRTStatus::Error(ERTResult::InvalidArgument, "a picture of another size");
		}
		for (uint32_t Pixel = 0; Pixel < Width * Height; ++Pixel)
		{
			if (Stage.IsFaulty() && Pixel % Width >= (Width & ~7u)) { Frame.Pixels[size_t(Pixel) * Frame.Channels] = 0.0f; }
			bool bWrong = false;
			for (uint32_t C = 0; C < Frame.Channels; ++C)
			{
				bWrong |= !(std::abs(double(Frame.Pixels[size_t(Pixel) * Frame.Channels + C]) - Value) <= Tolerance * Value);
			}
			OutWrong += bWrong ? 1 : 0;
		}
	}
	if (Width == 97) { Stage.AddToStrip(Frames.back(), {}); }
	return FRTStatus::Success();
}
} // namespace

/// A plane on which every signal has one value, at sizes that are no multiple of anything: pixels with another value in four
/// frames. Then odd numbers of rays. The fault: columns beyond the last whole tile of 8 are not written.
FRTStatus MeasureOddSizes(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out)
{
	if (FRTStatus S = Stage.Load(GetSignalInfo(Stage.GetSignal()).bSpecular ? "stability-flat:1" : "stability-flat:0"); !S) { return S; }
	const std::pair<uint32_t, uint32_t> Sizes[] = {{1, 1}, {1, 37}, {53, 1}, {2, 3}, {7, 5}, {97, 61}, {64, 36}, {131, 73}};
	uint64_t Wrong = 0;
	{
		FMethodScope Many;
		if (Stage.GetSignal() == ESignal::RoughSpecular) // a pixel or a row of them has few neighbours to filter its noise with
		{
			if (!Many.Apply({{"r.RT.GI.Samples", "64", "odd sizes"}}).empty())
			{
				return FRTStatus::Error(ERTResult::InvalidArgument, "64 samples");
			}
		}
		for (const auto& [Width, Height] : Sizes)
		{
			if (FRTStatus S = CountWrongPixels(Stage, Width, Height, Wrong); !S) { return S; }
		}
	}
	Out.push_back({"pixels, odd sizes", double(Wrong), 0.0});
	Wrong = 0;
	for (const char* Value : {"3", "7"})
	{
		FMethodScope Odd;
		std::vector<FMethodSetting> Settings;
		for (const FRTConsoleVariable* const Variable : FConsoleVariables::Get().GetAll())
		{
			if (Variable->GetName().ends_with(".Samples")) { Settings.push_back({Variable->GetName(), Value, "odd numbers of rays"}); }
		}
		if (!Odd.Apply(Settings).empty()) { return FRTStatus::Error(ERTResult::InvalidArgument, "%s rays", Value); }
		if (FRTStatus S = CountWrongPixels(Stage, 37, 23, Wrong); !S) { return S; }
	}
	Out.push_back({"pixels, odd numbers of rays", double(Wrong), 0.0});
	return FRTStatus::Success();
}

} // namespace Lantern
