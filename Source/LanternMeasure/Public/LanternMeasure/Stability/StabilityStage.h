// The stage for cases of `lantern stability`: loads scenes, plays sequences of one method's signal, and provides references.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "LanternHost/SampleEngine.h"
#include "LanternMeasure/SignalReference.h"
#include "LanternMeasure/Stability/StabilityCase.h"

namespace Lantern
{

struct FStabilitySettings
{
	uint32_t Width = 96, Height = 54;
	uint32_t ReferenceSamples = 4096;
	uint32_t Bounces = 16;
	bool bQuick = false;
	std::string CacheFolder;
};

/// A frame of a sequence.
struct FStabilityShot
{
	FView View;
	double Time = 0.0;
	/// Runs before the frame. It must set an absolute state of the scene. May be empty.
	std::function<void(FHostScene&)> Change;
	bool bKeep = false; ///< return its picture
	/// Histories whose names contain this are set to not-a-number before the frame; "*": all.
	std::string Poison;
};

class FStabilityStage
{
public:
	FStabilityStage(FSampleEngine& InEngine, FStabilitySettings InSettings) : Engine(InEngine), Settings(std::move(InSettings)) {}

	/// Begins a run. Fault: null if nothing is broken.
	void Begin(ESignal InSignal, uint32_t InSeed, const FStabilityFault* InFault);

	/// Loads a built-in scene, or resets it: objects, sun and sky return to their initial state.
	FRTStatus Load(const std::string& Scene);
	/// Loads a scene that has a parameter LAMP: with a lamp if the signal is of lamps, else with the sun.
	FRTStatus LoadLit(const std::string& Scene);
	FSampleEngine& GetEngine() { return Engine; }
	FHostScene& GetScene() { return Engine.GetScene(); }
	const FStabilitySettings& GetSettings() const { return Settings; }
	ESignal GetSignal() const { return Signal; }
	/// Whether something is broken, by console variables or by the case itself.
	bool IsBroken() const { return Fault != nullptr; }
	/// Whether the case itself must break something.
	bool IsFaulty() const { return Fault && Fault->Settings.empty(); }

	/// Returns the view of the scene's camera, with DeltaSeconds for 60 frames a second.
	FView MakeView() const;
	FView MakeView(glm::dvec3 Position, glm::dvec3 Target, float FovYDegrees) const;

	/// Plays shots from empty histories. OutFrames has as many pictures as shots; those without bKeep are empty. Fails if the
	/// method does not make its signal. Run selects other random numbers of one seed.
	FRTStatus Play(const std::vector<FStabilityShot>& Shots, std::vector<FImage>& OutFrames, int Run = 0);
	/// Whether the method of the last Play has a history.
	bool KeepsHistory() const { return bKeepsHistory; }
	/// Traces or reads a reference of the scene in its current state. Play plays whole sequences, so that this never falls
	/// between their frames. Bounces: at least; 0: as many as the settings say.
	FRTStatus GetReference(const FView& View, double Time, FSignalReference& Out, uint32_t Bounces = 0);

	/// Adds a frame and its reference (may be empty) to the picture strip, which holds the newest run only.
	void AddToStrip(const FImage& Frame, const FImage& Reference);
	const std::vector<std::pair<FImage, FImage>>& GetStrip() const { return Strip; }
	/// Returns the exposure for pictures of radiance.
	float GetExposure() const { return Exposure; }

private:
	void ResetState();

	FSampleEngine& Engine;
	FStabilitySettings Settings;
	ESignal Signal = ESignal::Frame;
	uint32_t Seed = 0;
	const FStabilityFault* Fault = nullptr;
	std::string LoadedScene;
	bool bKeepsHistory = false;
	float Exposure = 0.0f;
	std::vector<std::pair<FImage, FImage>> Strip;
};

} // namespace Lantern
