// What is accumulated while something moves: the camera past poles (stability case 9), a fan under a soft sun (11), the same
// change at other frame rates (18). Each test is run a second time with what it is about switched off, and must notice.
#include <cmath>

#include "DenoiseFixture.h"
#include "LanternImage/ImageIO.h"
#include "Support/TestScene.h"

namespace Lantern
{

namespace
{
constexpr float PoleZ = -2.0f, PoleHalf = 0.08f, PoleHeight = 2.5f, PoleDistance = 0.8f;

class FDenoiseMotionTest : public FDenoiseTest
{
protected:
	/// A floor with the penumbra of a roof's edge along the strafing camera's way, seen past poles that cast no shadow on it.
	[[nodiscard]] bool LoadPoles()
	{
		FTestScene Poles("poles");
		const int32_t Lambert = Poles.AddLambert(glm::vec3(0.5f), glm::vec3(0), true);
		Poles.AddNode(Poles.AddMesh({FTestScene::MakeFloor(Lambert, 30.0f)}));
		const auto AddQuad = [&](glm::vec3 A, glm::vec3 B, glm::vec3 C, glm::vec3 D) {
			Poles.AddNode(Poles.AddMesh({{Lambert, {A, B, C, D}}}));
		};
		// So high above that all of the floor that is looked at lies in its edge's penumbra.
		AddQuad({-30, 20, -5.5}, {30, 20, -5.5}, {30, 20, -30}, {-30, 20, -30});
		for (int I = -4; I <= 4; ++I)
		{
			const float X = float(I) * PoleDistance;
			AddQuad(
			    {X - PoleHalf, 0, PoleZ}, {X + PoleHalf, 0, PoleZ}, {X + PoleHalf, PoleHeight, PoleZ}, {X - PoleHalf, PoleHeight, PoleZ});
		}
		if (!Load(std::move(Poles.Scene))) { return false; }
		SetSun(20.0, 4.0f, {0, -1, 0});
		return true;
	}
	static FView MakeStrafe(uint32_t Frame)
	{
		FView View = LookAt({-0.6 + 0.03 * Frame, 1.8, 0}, {-0.6 + 0.03 * Frame, 0, -5}, 0.9f, 128, 72);
		View.DeltaSeconds = 1.0f / 60.0f;
		return View;
	}
	/// Whether the floor's point at a pixel of the view is seen by the camera of another frame. −1: the pixel shows no floor in the penumbra.
	static int IsFloorSeen(const FView& View, uint32_t X, uint32_t Y, const FView& Other)
	{
		const glm::dvec3 Ahead = glm::normalize(glm::dvec3(View.Forward)), Right = glm::normalize(glm::cross(Ahead, glm::dvec3(0, 1, 0)));
		const glm::dvec3 Up = glm::cross(Right, Ahead);
		const double Tan = std::tan(0.5 * View.FovY);
		const glm::dvec3 Ray = Ahead + Right * (((X + 0.5) / View.Width * 2 - 1) * Tan * View.Width / View.Height) +
		                       Up * ((1 - (Y + 0.5) / View.Height * 2) * Tan);
		if (Ray.y >= -1e-3) { return -1; }
		const glm::dvec3 Floor = View.Position - Ray * (View.Position.y / Ray.y);
		if (Floor.z > -3.5 || Floor.z < -7.5) { return -1; }
		const auto IsHidden = [&](glm::dvec3 From) {
			const double T = (PoleZ - From.z) / (Floor.z - From.z);
			if (T <= 0.0 || T >= 1.0) { return false; }
			const glm::dvec3 At = From + (Floor - From) * T;
			const double Nearest = std::round(At.x / PoleDistance);
			return At.y < PoleHeight && std::abs(Nearest) < 4.5 && std::abs(At.x - Nearest * PoleDistance) < PoleHalf;
		};
		if (IsHidden(View.Position)) { return -1; }
		return IsHidden(Other.Position) ? 0 : 1;
	}
	struct FMasks
	{
		std::vector<uint8_t> Fresh, Old; ///< seen for less than four frames, and for long
	};
	static FMasks MakeMasks(uint32_t Frame)
	{
		const FView View = MakeStrafe(Frame);
		FMasks Masks;
		for (uint32_t Y = 0; Y < View.Height; ++Y)
		{
			for (uint32_t X = 0; X < View.Width; ++X)
			{
				bool bSeenLong = true;
				int Seen[21];
				for (uint32_t Back = 1; Back <= 20; ++Back)
				{
					Seen[Back] = IsFloorSeen(View, X, Y, MakeStrafe(Frame - Back));
					bSeenLong &= Seen[Back] == 1;
				}
				// Columns that come in at the side are nobody's.
				const bool bInside = X >= 24 && X < View.Width - 24;
				Masks.Fresh.push_back(bInside && Seen[1] == 1 && Seen[2] == 1 && Seen[3] == 1 && Seen[4] == 0);
				Masks.Old.push_back(bInside && bSeenLong);
			}
		}
		return Masks;
	}
	static double MeanOf(const FImage& Image, const std::vector<uint8_t>& Mask)
	{
		double Sum = 0.0, Count = 0.0;
		for (size_t I = 0; I < Mask.size(); ++I)
		{
			Sum += Mask[I] * double(Image.Pixels[I]);
			Count += Mask[I];
		}
		return Sum / Count;
	}
};

// Where the floor comes out from behind a pole it has no history. After four frames it is at most three times as wrong as
// what has always been seen, and no darker.
TEST_F(FDenoiseMotionTest, Disocclusion)
{
	ASSERT_TRUE(LoadPoles());
	struct FFigures
	{
		double Fresh = 0.0, Old = 0.0, Darker = 0.0;
	};
	std::vector<FImage> Truths;
	const std::vector<uint32_t> Looked = {24, 28, 32, 36};
	for (const uint32_t Frame : Looked) { Truths.push_back(RenderTruth(MakeStrafe(Frame), 2)); }
	const auto Measure = [&] {
		UseFilter();
		FSequence Sequence;
		Sequence.Camera = MakeStrafe;
		Sequence.Frames = Looked.back() + 1;
		const std::vector<FImage> Images = RenderSequence(Sequence);
		FFigures Figures;
		double Shown = 0.0, Right = 0.0;
		for (size_t I = 0; I < Looked.size(); ++I)
		{
			const FMasks Masks = MakeMasks(Looked[I]);
			Figures.Fresh += ComputeRelMse(Images[Looked[I]], Truths[I], Masks.Fresh) / double(Looked.size());
			Figures.Old += ComputeRelMse(Images[Looked[I]], Truths[I], Masks.Old) / double(Looked.size());
			Shown += MeanOf(Images[Looked[I]], Masks.Fresh);
			Right += MeanOf(Truths[I], Masks.Fresh);
		}
		Figures.Darker = 1.0 - Shown / Right;
		PrintFigure(fmt::format("disocclusion: relMSE after four frames {:.4f}, elsewhere {:.4f} (ratio {:.2f}); darker by {:.2f} %",
		    Figures.Fresh, Figures.Old, Figures.Fresh / Figures.Old, 100 * Figures.Darker));
		return Figures;
	};
	const FFigures Figures = Measure();
	EXPECT_LE(Figures.Fresh, 3.0 * Figures.Old);
	EXPECT_LE(std::abs(Figures.Darker), 0.05);
	// Planted: what the pole looked like is taken for the floor.
	SetVariable("r.RT.Debug.Denoise.Validate", "0");
	SetVariable("r.RT.Debug.Denoise.Adapt", "0");
	const FFigures Faulty = Measure();
	EXPECT_TRUE(Faulty.Fresh > 3.0 * Faulty.Old || std::abs(Faulty.Darker) > 0.05);
}

// The shadow of a turning fan is where the fan's shadow is.
TEST_F(FDenoiseMotionTest, TurningFan)
{
	ASSERT_TRUE(Load("stability-fan"));
	constexpr double Fps = 60.0;
	constexpr uint32_t Last = 30;
	const auto GetTime = [](uint32_t Frame) { return double(Frame) / Fps; };
	const FView View = MakeView(128, 72);
	FImage Truths[4];
	for (uint32_t Back = 0; Back < 4; ++Back) { Truths[Back] = RenderTruth(View, 2, GetTime(Last - Back)); }
	const auto Measure = [&](uint32_t& OutLag) {
		UseFilter();
		FSequence Sequence;
		Sequence.Camera = [&](uint32_t) { return View; };
		Sequence.Time = GetTime;
		Sequence.Frames = Last + 1;
		const FImage Image = RenderSequence(Sequence).back();
		size_t Both = 0, Either = 0;
		for (size_t I = 0; I < Image.Pixels.size(); ++I)
		{
			const bool bShown = Image.Pixels[I] < 0.5f, bRight = Truths[0].Pixels[I] < 0.5f;
			Both += bShown && bRight;
			Either += bShown || bRight;
		}
		OutLag = 0;
		for (uint32_t Back = 1; Back < 4; ++Back)
		{
			if (ComputeMeanSquare(Image, Truths[Back]) < ComputeMeanSquare(Image, Truths[OutLag])) { OutLag = Back; }
		}
		const double Overlap = double(Both) / double(std::max<size_t>(Either, 1));
		PrintFigure(fmt::format(
		    "fan: overlap {:.3f}, lag {} frames, error {:.4f}", Overlap, OutLag, std::sqrt(ComputeMeanSquare(Image, Truths[0]))));
		return Overlap;
	};
	uint32_t Lag = 0;
	EXPECT_GE(Measure(Lag), 0.9);
	EXPECT_LE(Lag, 1u);
	// Planted: what was accumulated is never compared with what is there now.
	SetVariable("r.RT.Debug.Denoise.Adapt", "0");
	SetVariable("r.RT.Shadow.HistorySeconds", "10");
	const double Faulty = Measure(Lag);
	EXPECT_TRUE(Faulty < 0.9 || Lag > 1);
}

// The filter of lamps looks for changes where a moved caster may lie between a lamp and the surface.
TEST_F(FDenoiseMotionTest, TurningFanUnderALamp)
{
	ASSERT_TRUE(Load("stability-fan:1"));
	constexpr uint32_t Frames = 24;
	FView View = MakeView(96, 54);
	const auto GetTime = [](uint32_t Frame) { return double(Frame) / 60.0; };
	SetVariable("r.RT.Lights.Denoise", "0");
	const FImage Truth = RenderSignal(ESignal::LocalDiffuse, View, 64, 0, GetTime(Frames - 1));
	SetVariable("r.RT.Lights.Denoise", "1");
	const auto Measure = [&](const char* Told) {
		SetVariable("r.RT.Debug.Shadow.Capsules", Told);
		FImage Image;
		for (uint32_t Frame = 0; Frame < Frames; ++Frame)
		{
			View.bCut = Frame == 0;
			Image = RenderSignal(ESignal::LocalDiffuse, View, 1, Frame, GetTime(Frame));
		}
		return ComputeRelMse(Image, Truth, {});
	};
	const double Told = Measure("1"), Untold = Measure("0");
	PrintFigure(fmt::format("fan under a lamp: relMSE {:.4f}, {:.4f} if nobody tells what moved", Told, Untold));
	EXPECT_LT(Told, 0.1 * Untold);
}

// The same change at 30, 60 and 144 frames a second takes the same time, not the same number of frames.
TEST_F(FDenoiseMotionTest, FrameRate)
{
	ASSERT_TRUE(Load("penumbra:1"));
	UseFilter();
	const auto Measure = [&](double Fps, bool bRightTime) {
		constexpr double Before = 1.0, After = 1.5;
		FSequence Sequence;
		Sequence.Camera = [&](uint32_t) {
			FView View = MakeView(96, 96);
			View.DeltaSeconds = float(1.0 / (bRightTime ? Fps : 60.0));
			return View;
		};
		// The edge's shadow moves by a twentieth of its penumbra: less than what is taken for a change of light.
		const auto First = static_cast<uint32_t>(Before * Fps);
		Sequence.Change = [&](uint32_t Frame) { SetSun(0.533, 4.0f, {Frame < First ? 0.0 : 0.0005, -1, 0}); };
		Sequence.Frames = First + static_cast<uint32_t>(After * Fps);
		const std::vector<FImage> Images = RenderSequence(Sequence);
		const double Start = MeanGreen(Images[First - 1]);
		double End = 0.0;
		const uint32_t Tail = Sequence.Frames / 20;
		for (uint32_t I = 0; I < Tail; ++I) { End += MeanGreen(Images[Sequence.Frames - 1 - I]) / Tail; }
		for (uint32_t Frame = First; Frame < Sequence.Frames; ++Frame)
		{
			const double Done = (MeanGreen(Images[Frame]) - Start) / (End - Start);
			const double DoneBefore = Frame == First ? 0.0 : (MeanGreen(Images[Frame - 1]) - Start) / (End - Start);
			if (Done >= 0.9) { return (Frame - First + (0.9 - DoneBefore) / (Done - DoneBefore)) / Fps; }
		}
		return After;
	};
	const double At60 = Measure(60, true);
	for (const double Fps : {30.0, 144.0})
	{
		const double Seconds = Measure(Fps, true);
		PrintFigure(fmt::format("90 % of a change: {:.3f} s at 60 frames a second, {:.3f} s at {}", At60, Seconds, Fps));
		EXPECT_NEAR(Seconds / At60, 1.0, 0.15) << Fps;
		EXPECT_GT(std::abs(Measure(Fps, false) / At60 - 1.0), 0.15) << "planted: time counted in frames";
	}
}

} // namespace
} // namespace Lantern
