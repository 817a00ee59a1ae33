// The judge's script: frames of the scene in three states, each compared with the truth.
#include "Judge/Checks.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <future>
#include <thread>
#include <utility>

#include "Judge/Judge.h"
#include "Judge/Verdict.h"

namespace Fork
{

using namespace Lantern;

namespace
{

constexpr int FrameCount = 3;                    // frames in which everything is built already
constexpr int MostFramesUntilComplete = 600'000; // each takes a millisecond at least: ends what would never end
constexpr int FramesPerLine = 5'000;

/// Temporal antialiasing: each frame's picture is a fraction of a pixel elsewhere (Halton, 1960).
void Jitter(FForkScene& Scene, int Frame)
{
	const auto Halton = [](int Index, int Base) {
		double Value = 0.0, Digit = 1.0;
		for (; Index > 0; Index /= Base) { Value += (Digit /= Base) * (Index % Base); }
		return Value;
	};
	const int Index = Frame % 8 + 1;
	for (FCamera& Camera : Scene.Cameras) { Camera.Jitter = glm::dvec2(Halton(Index, 2), Halton(Index, 3)) - 0.5; }
}

} // namespace

FError RunUntilComplete(FJudge& Judge, FMasks& Out)
{
	FError Error;
	for (int Frame = 0; Error.empty() && Frame < MostFramesUntilComplete; ++Frame)
	{
		Jitter(Judge.Scene, Frame);
		Error = Judge.Engine.RunFrame(Judge.Scene, Frame == 0, Out); // boxes have jumped since the scene before
		if (Judge.Engine.GetPlugin().IsComplete()) { break; }
		if (Frame % FramesPerLine == FramesPerLine - 1)
		{
			std::fprintf(stderr, "EngineFork: frame %d, and the plugin still compiles\n", Frame + 1);
		}
		std::this_thread::sleep_for(std::chrono::milliseconds(1));
	}
	for (int Frame = 0; Error.empty() && Frame < FrameCount; ++Frame)
	{
		Jitter(Judge.Scene, Frame);
		Error = Judge.Engine.RunFrame(Judge.Scene, false, Out);
	}
	for (const FFrameMasks& Masks : Out)
	{
		const FSignalSet Wanted = Judge.Engine.GetPlugin().Wanted;
		const bool bShadow = Masks.SunShadow != nullptr, bOcclusion = Masks.AmbientOcclusion != nullptr;
		const bool bAsWanted = Wanted.Has(ESignal::SunShadow) == bShadow && Wanted.Has(ESignal::AmbientOcclusion) == bOcclusion;
		if (Error.empty() && !bAsWanted) { return "the plugin gave less than was wanted, or more"; }
	}
	return Error;
}

namespace
{

/// Compares every pixel of a view's last mask with the truth.
FError CheckView(const FJudge& Judge, uint32_t View, const char* What, const FFrameMasks& Masks)
{
	if (FError Error = JudgeOcclusion(Masks.AmbientOcclusion); !Error.empty()) { return Error; }
	const FShadowPicture Expected = ExpectShadow(Judge.Scene, Judge.Scene.Cameras[View]);
	if (FError Error = JudgeLight(Expected, Masks); !Error.empty()) { return std::string(What) + ": " + Error; }
	const FVerdict Verdict = JudgeShadow(Expected, Masks.SunShadow);
	std::printf("%s, view %u: %u lit, %u shadowed, %u sky, %u near an edge; wrong: %u\n", What, View, Verdict.Lit, Verdict.Shadowed,
	    Verdict.Sky, Verdict.Unsure, Verdict.Wrong);
	if (!Judge.Pictures.empty())
	{
		const std::string Path = Judge.Pictures + std::to_string(Judge.Checks) + "-" + std::to_string(View) + ".ppm";
		if (FError Error = WritePicture(Path, Expected, Masks.SunShadow); !Error.empty()) { return Error; }
	}
	// Enough of each that agreeing means something.
	const bool bMeaningful = Verdict.Lit > PixelCount / 12 && Verdict.Shadowed > PixelCount / 60 && Verdict.Sky > PixelCount / 30;
	return Verdict.Wrong == 0 && bMeaningful ? FError() : std::string(What) + ": the shadows are not where they must be";
}

FError CheckScene(FJudge& Judge, const char* What)
{
	FMasks Masks;
	FError Error = RunUntilComplete(Judge, Masks);
	for (uint32_t View = 0; Error.empty() && View < ViewCount; ++View) { Error = CheckView(Judge, View, What, Masks[View]); }
	++Judge.Checks;
	return Error;
}

/// Without the plugin's outputs the engine lights as if there were no plugin.
FError CheckUnwanted(FJudge& Judge)
{
	const FSignalSet Wanted = std::exchange(Judge.Engine.GetPlugin().Wanted, FSignalSet{});
	FMasks Masks;
	FError Error = RunUntilComplete(Judge, Masks);
	for (uint32_t View = 0; Error.empty() && View < ViewCount; ++View)
	{
		Error = JudgeLight(ExpectShadow(Judge.Scene, Judge.Scene.Cameras[View]), Masks[View]);
	}
	Judge.Engine.GetPlugin().Wanted = Wanted;
	return Error.empty() ? Error : "without outputs: " + Error;
}

/// Frames after a cut, the first camera moving by Step before each. The last frame's jitter is the same for every Count. Out: ambient
/// occlusion of the first view.
FError RunFrames(FJudge& Judge, int Count, bool bCut, glm::dvec3 Step, std::vector<float>& Out)
{
	FMasks Masks;
	FError Error;
	for (int Frame = 0; Error.empty() && Frame < Count; ++Frame)
	{
		Judge.Scene.Cameras[0].Position += Step;
		Jitter(Judge.Scene, Count - 1 - Frame);
		Error = Judge.Engine.RunFrame(Judge.Scene, bCut && Frame == 0, Masks);
	}
	if (Error.empty()) { Out = ReadMask(Masks[0].AmbientOcclusion); }
	return Error;
}

/// Motion vectors: what accumulated before the camera moved is still worth something behind it.
FError CheckMotion(FJudge& Judge)
{
	constexpr int StillFrames = 32, MovingFrames = 8;
	const glm::dvec3 Step = At(0.15, 0.03, -0.1), Rest(0); // some pixels for each frame
	const FCamera Start = Judge.Scene.Cameras[0];
	std::vector<float> Before, Moved, Settled, Fresh;
	FError Error = RunFrames(Judge, StillFrames, true, Rest, Before);
	if (Error.empty()) { Error = RunFrames(Judge, MovingFrames, false, Step, Moved); }
	if (Error.empty()) { Error = RunFrames(Judge, StillFrames, true, Rest, Settled); }
	if (Error.empty()) { Error = RunFrames(Judge, 1, true, Rest, Fresh); }
	Judge.Scene.Cameras[0] = Start;
	if (!Error.empty()) { return Error; }
	const double AfterMotion = Compare(Moved, Settled), AfterCut = Compare(Fresh, Settled);
	std::printf("motion: occlusion is off by %.5f behind a moving camera, by %.5f after a cut\n", AfterMotion, AfterCut);
	constexpr double Limit = 0.6; // halfway: 0.40 as it should be, 0.77 with vectors that lead the wrong way
	return AfterMotion < Limit * AfterCut ? FError() : "what was accumulated does not follow motion";
}

/// As after a lost device. All that changed so far must be there on the new one.
FError CheckOtherDevice(FJudge& Judge)
{
	const FError Error = Judge.Engine.ChangeDevice();
	return Error.empty() ? CheckScene(Judge, "on another device") : Error;
}

FError CheckMoved(FJudge& Judge)
{
	std::vector<FBox>& Boxes = Judge.Scene.Boxes;
	Boxes[2].Centre += At(-3.0, 0.0, 4.0);
	FError Error = Judge.Engine.GetPlugin().MoveBox(2, Boxes[2]);
	Boxes.erase(Boxes.begin() + 1);
	if (Error.empty()) { Error = Judge.Engine.GetPlugin().RemoveBox(1); }
	return Error.empty() ? CheckScene(Judge, "pillar moved, cube gone") : Error;
}

/// The boxes are as CheckMoved left them: floor, pillar, slab, cut-out.
FError CheckChanged(FJudge& Judge)
{
	constexpr float Scale = 0.75f;
	std::vector<FBox>& Boxes = Judge.Scene.Boxes;
	Boxes[1].HalfSize *= Scale;
	FError Error = Judge.Engine.GetPlugin().ScaleVertices(Scale);
	Boxes[2].bCastsShadow = true;
	Boxes[3].bCutOut = false;
	Judge.Scene.Reed.Bend = -0.8;
	for (size_t Box = 2; Error.empty() && Box <= 3; ++Box) { Error = Judge.Engine.GetPlugin().SetBox(Box, Boxes[Box]); }
	return Error.empty() ? CheckScene(Judge, "pillar deformed, reed bent, slab and cut-out cast shadows") : Error;
}

/// The game: boxes come and go, as around a camera that flies, without regard to frames.
FError StreamBoxes(FForkEngine& Engine, FForkScene& Scene)
{
	constexpr int Steps = 60;
	constexpr size_t MostBoxes = 6;
	const size_t First = Scene.Boxes.size();
	const glm::dvec3 Floor = Scene.Boxes[0].Centre + glm::dvec3(0, 0, Scene.Boxes[0].HalfSize.z);
	FError Error;
	for (int Step = 0; Error.empty() && Step < Steps; ++Step)
	{
		const double Angle = Step * 0.9;
		Scene.Boxes.push_back({Floor + At(7.0 * std::cos(Angle), 0.6, 6.0 * std::sin(Angle)), At(0.3, 0.6, 0.5)});
		Error = Engine.GetPlugin().StreamIn(Scene.Boxes.back());
		if (Error.empty() && Scene.Boxes.size() > First + MostBoxes)
		{
			Scene.Boxes.erase(Scene.Boxes.begin() + static_cast<std::ptrdiff_t>(First));
			Error = Engine.GetPlugin().RemoveBox(First);
		}
		std::this_thread::sleep_for(std::chrono::milliseconds(1));
	}
	return Error;
}

/// The game thread streams while the render thread draws. What stays at last must be there, and nothing else.
FError CheckStreamed(FJudge& Judge)
{
	FForkScene Game = Judge.Scene;
	FMasks Masks;
	std::future<FError> Streamed = std::async(std::launch::async, [&] { return StreamBoxes(Judge.Engine, Game); });
	FError Error;
	do {
		const FError Frame = Judge.Engine.RunFrame(Judge.Scene, false, Masks);
		Error = Error.empty() ? Frame : Error;
	}
	while (Streamed.wait_for(std::chrono::seconds(0)) != std::future_status::ready);
	const FError OfGame = Streamed.get();
	Judge.Scene = std::move(Game);
	Error = Error.empty() ? OfGame : Error;
	return Error.empty() ? CheckScene(Judge, "boxes streamed in and out") : Error;
}

} // namespace

FError CheckScenes(FForkEngine& Engine, FForkScene Scene, const std::string& Pictures, bool bChanges)
{
	FJudge Judge{Engine, std::move(Scene), Pictures};
	FError Error = CheckScene(Judge, "as made");
	for (FError (*const Check)(FJudge&) : {CheckUnwanted, CheckMotion, CheckMoved, CheckOtherDevice, CheckLamp, CheckSquareLamp,
	         CheckLightMask, CheckGlass, CheckChanged, CheckStreamed, CheckOtherDevice})
	{
		if (Error.empty() && bChanges) { Error = Check(Judge); }
	}
	return Error;
}

} // namespace Fork
