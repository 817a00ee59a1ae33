// The judge's script: frames of the scene in three states, each compared with the truth.
#include "Judge/Checks.h"

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

/// Runs frames until the plugin has all that it needs, then a few more. The plugin never waits: its first frames may lack shadows.
FError RunUntilComplete(FForkEngine& Engine, const FForkScene& Scene, FFrameMasks& Out)
{
	FError Error;
	for (int Frame = 0; Error.empty() && Frame < MostFramesUntilComplete; ++Frame)
	{
		Error = Engine.RunFrame(Scene, Frame == 0, Out); // boxes have jumped since the scene before
		if (Engine.GetPlugin().IsComplete()) { break; }
		if (Frame % FramesPerLine == FramesPerLine - 1)
		{
			std::fprintf(stderr, "EngineFork: frame %d, and the plugin still compiles\n", Frame + 1);
		}
		std::this_thread::sleep_for(std::chrono::milliseconds(1));
	}
	for (int Frame = 0; Error.empty() && Frame < FrameCount; ++Frame) { Error = Engine.RunFrame(Scene, false, Out); }
	const bool bHasMasks = Out.SunShadow != nullptr && Out.AmbientOcclusion != nullptr;
	return Error.empty() && !bHasMasks ? "the plugin gave no shadow mask, or no ambient occlusion" : Error;
}

/// Compares every pixel of the last mask with the truth.
FError CheckScene(FForkEngine& Engine, const FForkScene& Scene, const char* What, FFrameMasks& Out)
{
	FError Error = RunUntilComplete(Engine, Scene, Out);
	if (Error.empty()) { Error = JudgeOcclusion(Out.AmbientOcclusion); }
	if (!Error.empty()) { return Error; }
	const FVerdict Verdict = JudgeShadow(Scene, Out.SunShadow);
	std::printf("%s: %u lit, %u shadowed, %u sky, %u near an edge; wrong: %u\n", What, Verdict.Lit, Verdict.Shadowed, Verdict.Sky,
	    Verdict.Unsure, Verdict.Wrong);
	// Enough of each that agreeing means something.
	const bool bMeaningful = Verdict.Lit > 5000 && Verdict.Shadowed > 1000 && Verdict.Sky > 2000;
	return Verdict.Wrong == 0 && bMeaningful ? FError() : std::string(What) + ": the shadows are not where they must be";
}

FError CheckMoved(FForkEngine& Engine, FForkScene& Scene)
{
	Scene.Boxes[2].Centre += glm::dvec3(-3.0, 0.0, 4.0);
	FError Error = Engine.GetPlugin().MoveBox(2, Scene.Boxes[2]);
	Scene.Boxes.erase(Scene.Boxes.begin() + 1);
	if (Error.empty()) { Error = Engine.GetPlugin().RemoveBox(1); }
	FFrameMasks Masks;
	return Error.empty() ? CheckScene(Engine, Scene, "pillar moved, cube gone", Masks) : Error;
}

/// The boxes are as CheckMoved left them: floor, pillar, slab, cut-out.
FError CheckChanged(FForkEngine& Engine, FForkScene& Scene)
{
	constexpr float Scale = 0.75f;
	Scene.Boxes[1].HalfSize *= Scale;
	FError Error = Engine.GetPlugin().ScaleVertices(Scale);
	Scene.Boxes[2].bCastsShadow = true;
	Scene.Boxes[3].bCutOut = false;
	Scene.Reed.Bend = -0.8;
	for (size_t Box = 2; Error.empty() && Box <= 3; ++Box) { Error = Engine.GetPlugin().SetBox(Box, Scene.Boxes[Box]); }
	FFrameMasks Masks;
	return Error.empty() ? CheckScene(Engine, Scene, "pillar deformed, reed bent, slab and cut-out cast shadows", Masks) : Error;
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
FError CheckStreamed(FForkEngine& Engine, FForkScene& Scene)
{
	FForkScene Game = Scene;
	FFrameMasks Masks;
	std::future<FError> Streamed = std::async(std::launch::async, [&] { return StreamBoxes(Engine, Game); });
	FError Error;
	do {
		const FError Frame = Engine.RunFrame(Scene, false, Masks);
		Error = Error.empty() ? Frame : Error;
	}
	while (Streamed.wait_for(std::chrono::seconds(0)) != std::future_status::ready);
	const FError OfGame = Streamed.get();
	Scene = std::move(Game);
	Error = Error.empty() ? OfGame : Error;
	return Error.empty() ? CheckScene(Engine, Scene, "boxes streamed in and out", Masks) : Error;
}

} // namespace

FError CheckScenes(FForkEngine& Engine, FForkScene Scene, const std::string& Picture)
{
	FFrameMasks Masks;
	FError Error = CheckScene(Engine, Scene, "as made", Masks);
	if (Error.empty() && !Picture.empty()) { Error = WritePicture(Picture, Masks.SunShadow); }
	if (Error.empty()) { Error = CheckMoved(Engine, Scene); }
	if (Error.empty()) { Error = CheckChanged(Engine, Scene); }
	return Error.empty() ? CheckStreamed(Engine, Scene) : Error;
}

} // namespace Fork
