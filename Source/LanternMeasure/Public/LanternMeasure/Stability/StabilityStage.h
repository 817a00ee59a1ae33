// Where cases of `lantern stability` are played: loads scenes, plays sequences of one method's signal, has references.
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
	/// Before the frame; sets the scene to a state, never relative to the one it is in. May be empty.
	std::function<void(FHostScene&)> Change;
	bool bKeep = false; ///< its picture is wanted
	/// Histories with this in their names are not-a-number when it begins; "*": all.
	std::string Poison;
};

class FStabilityStage
{
public:
	FStabilityStage(FSampleEngine& InEngine, FStabilitySettings InSettings) : Engine(InEngine), Settings(std::move(InSettings)) {}

	/// What runs next. Fault: null where nothing is broken.
	void Begin(ESignal InSignal, uint32_t InSeed, const FStabilityFault* InFault);

	/// A built-in scene, in its first state: moved objects, sun and sky are as the scene says.
	FRTStatus Load(const std::string& Scene);
	FSampleEngine& GetEngine() { return Engine; }
	FHostScene& GetScene() { return Engine.GetScene(); }
	const FStabilitySettings& GetSettings() const { return Settings; }
	ESignal GetSignal() const { return Signal; }
	uint32_t GetSeed() const { return Seed; }
	/// Something is broken, be it by console variables …
	bool IsBroken() const { return Fault != nullptr; }
	/// … or by the case itself.
	bool IsFaulty() const { return Fault && Fault->Settings.empty(); }

	/// The scene's camera; DeltaSeconds for 60 frames a second.
	FView MakeView() const;
	FView MakeView(glm::dvec3 Position, glm::dvec3 Target, float FovYDegrees) const;

	/// From empty histories. OutFrames: as many as shots; empty pictures where they were not wanted. An error where the
	/// method does not make its signal. Run: other random numbers of the same seed.
	FRTStatus Play(const std::vector<FStabilityShot>& Shots, std::vector<FImage>& OutFrames, int Run = 0);
	/// Whether the method of the last Play keeps anything from frame to frame.
	bool KeepsHistory() const { return bKeepsHistory; }
	/// Of the scene in its present state. Not between the frames of a sequence: Play is one.
	FRTStatus GetReference(const FView& View, double Time, FSignalReference& Out);

	/// Pictures for the strip, newest run only: a frame and what it should be (may be empty).
	void AddToStrip(const FImage& Frame, const FImage& Reference);
	const std::vector<std::pair<FImage, FImage>>& GetStrip() const { return Strip; }
	/// For pictures of radiance.
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
