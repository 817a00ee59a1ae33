// The judge's script: frames of the scene in three states, each compared with the truth.
#include "Judge/Checks.h"

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <future>
#include <thread>
#include <utility>

#include "Judge/Verdict.h"

namespace Fork
{

namespace
{

constexpr int FrameCount = 3;                    // frames in which everything is built already
constexpr int MostFramesUntilComplete = 600'000; // each takes a millisecond at least: ends what would never end
constexpr int FramesPerLine = 5'000;

using FMasks = std::array<FFrameMasks, ViewCount>;

struct FJudge
{
	FForkEngine& Engine;
	FForkScene Scene;
	std::string Pictures; ///< begin of their paths; empty: none
	int Checks = 0;
};

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

/// Runs frames until the plugin has all that it needs, then a few more. The plugin never waits: its first frames may lack shadows.
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
	bool bHasMasks = true;
	for (const FFrameMasks& Masks : Out) { bHasMasks = bHasMasks && Masks.SunShadow != nullptr && Masks.AmbientOcclusion != nullptr; }
	return Error.empty() && !bHasMasks ? "the plugin gave no shadow mask, or no ambient occlusion" : Error;
}

/// Compares every pixel of a view's last mask with the truth.
FError CheckView(const FJudge& Judge, size_t View, const char* What, const FFrameMasks& Masks)
{
	if (FError Error = JudgeOcclusion(Masks.AmbientOcclusion); !Error.empty()) { return Error; }
	const FShadowPicture Expected = ExpectShadow(Judge.Scene, Judge.Scene.Cameras[View]);
	const FVerdict Verdict = JudgeShadow(Expected, Masks.SunShadow);
	std::printf("%s, view %zu: %u lit, %u shadowed, %u sky, %u near an edge; wrong: %u\n", What, View, Verdict.Lit, Verdict.Shadowed,
	    Verdict.Sky, Verdict.Unsure, Verdict.Wrong);
	if (!Judge.Pictures.empty())
	{
		const std::string Path = Judge.Pictures + std::to_string(Judge.Checks) + "-" + std::to_string(View) + ".ppm";
		if (FError Error = WritePicture(Path, Expected, Masks.SunShadow); !Error.empty()) { return Error; }
	}
	// Enough of each that agreeing means something.
	const bool bMeaningful = Verdict.Lit > 5000 && Verdict.Shadowed > 1000 && Verdict.Sky > 2000;
	return Verdict.Wrong == 0 && bMeaningful ? FError() : std::string(What) + ": the shadows are not where they must be";
}

FError CheckScene(FJudge& Judge, const char* What)
{
	FMasks Masks;
	FError Error = RunUntilComplete(Judge, Masks);
	for (size_t View = 0; Error.empty() && View < ViewCount; ++View) { Error = CheckView(Judge, View, What, Masks[View]); }
	++Judge.Checks;
	return Error;
}

FError CheckMoved(FJudge& Judge)
{
	std::vector<FBox>& Boxes = Judge.Scene.Boxes;
	Boxes[2].Centre += glm::dvec3(-3.0, 0.0, 4.0);
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
	const glm::dvec3 Floor = Scene.Boxes[0].Centre + glm::dvec3(0, Scene.Boxes[0].HalfSize.y, 0);
	FError Error;
	for (int Step = 0; Error.empty() && Step < Steps; ++Step)
	{
		const double Angle = Step * 0.9;
		Scene.Boxes.push_back({Floor + glm::dvec3(7.0 * std::cos(Angle), 0.6, 6.0 * std::sin(Angle)), glm::dvec3(0.3, 0.6, 0.5)});
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

FError CheckScenes(FForkEngine& Engine, FForkScene Scene, const std::string& Pictures)
{
	FJudge Judge{Engine, std::move(Scene), Pictures};
	FError Error = CheckScene(Judge, "as made");
	if (Error.empty()) { Error = CheckMoved(Judge); }
	if (Error.empty()) { Error = CheckChanged(Judge); }
	return Error.empty() ? CheckStreamed(Judge) : Error;
}

} // namespace Fork
