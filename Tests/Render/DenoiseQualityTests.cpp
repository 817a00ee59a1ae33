// Filtered shadows of one ray a pixel against unfiltered ones, by FLIP, with the camera still, slow and fast. A still picture must beat
// sixteen rays. A moving one must not lose what the one ray had: penumbrae of a pixel or two lie in no other frame's pixels, and a filter
// that does not know it blurs them. With further rays where histories fail (r.RT.Shadow.MoreRays) it must about halve the one ray's error.
#include <cstdlib>
#include <filesystem>

#include "DenoiseFixture.h"
#include "LanternHost/SceneViews.h"
#include "LanternImage/Flip.h"
#include "LanternImage/ImageIO.h"

namespace Lantern
{

namespace
{
struct FPath
{
	const char* Name;
	double Speed; ///< metres a second, to the right
	double Turn;  ///< degrees a second
};
constexpr FPath Paths[] = {{"still", 0.0, 0.0}, {"slow", 0.5, 5.0}, {"fast", 3.0, 45.0}};
constexpr double Fps = 60.0;
constexpr uint32_t Width = 192, Height = 108;

/// Pictures and truths of a run, where LANTERN_DENOISE_PICTURES names a folder: to look at, and not to trace truths again.
std::string GetPictureFolder()
{
	const char* const Folder = std::getenv("LANTERN_DENOISE_PICTURES");
	return Folder ? std::string(Folder) + "/" : std::string();
}

class FDenoiseQualityTest : public FDenoiseTest
{
protected:
	struct FFigures
	{
		double Flip = 0.0, RelMse = 0.0;
	};
	static FFigures Measure(const FImage& Image, const FImage& Truth)
	{
		return {PoolFlip(ComputeFlip(Image, Truth).Map).Mean, ComputeRelMse(Image, Truth)};
	}

	static void Keep(const std::string& Name, const FImage& Image)
	{
		if (!GetPictureFolder().empty()) { EXPECT_OK(SaveImageFile(GetPictureFolder() + Name, Image)); }
	}

	static FImage GetTruth(const std::string& Name, const FView& View)
	{
		const std::string File = GetPictureFolder() + Name + ".pfm";
		FImage Truth;
		if (!GetPictureFolder().empty() && std::filesystem::exists(File) && LoadImageFile(File, Truth)) { return Truth; }
		Truth = RenderTruth(View, 2);
		Keep(Name + ".pfm", Truth);
		return Truth;
	}

	/// Mean figures of a few frames of the sequence, with what the console variables say. Without a filter no frame needs
	/// those before it.
	static FFigures MeasureSequence(const std::string& Name, const char* Method, const FSequence& Sequence,
	    const std::vector<uint32_t>& Looked, const std::vector<FImage>& Truths, bool bFiltered)
	{
		std::vector<FImage> Images(Sequence.Frames);
		if (bFiltered) { Images = RenderSequence(Sequence); }
		for (const uint32_t Frame : Looked)
		{
			if (bFiltered) { continue; }
			FSequence Alone = Sequence;
			Alone.Frames = 1;
			Alone.FirstIndex = Sequence.FirstIndex + Frame;
			Alone.Camera = [&](uint32_t) { return Sequence.Camera(Frame); };
			Images[Frame] = RenderSequence(Alone)[0];
		}
		FFigures Mean;
		for (size_t I = 0; I < Looked.size(); ++I)
		{
			const FFigures Figures = Measure(Images[Looked[I]], Truths[I]);
			Mean.Flip += Figures.Flip / double(Looked.size());
			Mean.RelMse += Figures.RelMse / double(Looked.size());
		}
		Keep(Name + "_" + Method + ".png", Images[Looked.back()]);
		return Mean;
	}

	/// MostLeft: share of the one ray's error that further rays may leave.
	void Compare(const std::string& Scene, const FView& Start, double MostLeft)
	{
		const std::vector<uint32_t> Looked = {20, 25, 30};
		for (const FPath& Path : Paths)
		{
			const std::string Name = Scene + "_" + Path.Name;
			FSequence Sequence;
			Sequence.Frames = Looked.back() + 1;
			Sequence.FirstIndex = 1000;
			Sequence.Camera = [&](uint32_t Frame) {
				const double Seconds = double(Frame) / Fps;
				FView View = Move(Start, Path.Speed * Seconds, 0.0, Path.Turn * Seconds);
				View.DeltaSeconds = float(1.0 / Fps);
				return View;
			};
			std::vector<FImage> Truths;
			for (const uint32_t Frame : Looked)
			{
				const bool bSame = Path.Speed == 0.0 && !Truths.empty();
				Truths.push_back(bSame ? FImage(Truths[0]) : GetTruth(fmt::format("{}_{}_truth", Name, Frame), Sequence.Camera(Frame)));
			}
			Keep(Name + "_truth.png", Truths.back());
			UseFilter();
			SetVariable("r.RT.Shadow.MoreRays", "0");
			const FFigures Filtered = MeasureSequence(Name, "filtered", Sequence, Looked, Truths, true);
			SetVariable("r.RT.Shadow.MoreRays", "15");
			const FFigures More = MeasureSequence(Name, "more", Sequence, Looked, Truths, true);
			SetVariable("r.RT.Shadow.MoreRays", "0");
			UseRays(16);
			const FFigures Raw = MeasureSequence(Name, "raw16", Sequence, Looked, Truths, false);
			UseRays(1);
			const FFigures One = MeasureSequence(Name, "raw1", Sequence, Looked, Truths, false);
			PrintFigure(fmt::format(
			    "{:24} FLIP: filtered {:.4f}, more rays {:.4f}, 16 rays {:.4f}, 1 ray {:.4f}; relMSE: {:.4f}, {:.4f}, {:.4f}, {:.4f}", Name,
			    Filtered.Flip, More.Flip, Raw.Flip, One.Flip, Filtered.RelMse, More.RelMse, Raw.RelMse, One.RelMse));
			EXPECT_LT(Filtered.Flip, Path.Speed == 0.0 ? Raw.Flip : 1.05 * One.Flip) << Name;
			EXPECT_LT(More.Flip, MostLeft * One.Flip) << Name;
			EXPECT_LT(Filtered.RelMse, One.RelMse) << Name;
		}
	}
};

TEST_F(FDenoiseQualityTest, Courtyard)
{
	ASSERT_TRUE(Load("courtyard"));
	Compare("courtyard", MakeView(Width, Height), 0.5);
}

TEST_F(FDenoiseQualityTest, BlackForest)
{
	REQUIRE_SCENE(File, "black_forest/black_forest.gltf");
	ASSERT_TRUE(Load(File));
	SetSun(0.53);
	// The frame that fits the whole world shows little but sky.
	const FSceneViews Views = LoadSceneViews(File);
	const FSceneView* const Main = Views.Find("main");
	ASSERT_TRUE(Main && Main->Camera) << Views.Error;
	const FView View = LookAt(Main->Camera->Position, Main->Camera->Target, glm::radians(float(Main->Camera->FovY)), Width, Height);
	// At this size gaps between leaves are narrower than a pixel, and what moves has no history to speak of.
	Compare("black_forest", View, 0.6);
}

} // namespace
} // namespace Lantern
