// The private half of the registry of signals (LanternSignals/Signals.h): how each one is made.
#pragma once

#include "Rays/ShadowRays.h"
#include "ReferenceTypes.h"

namespace Lantern
{

struct FSignalPass
{
	ESignal Signal;
	/// What the pass traces in a frame. Path None: it is off, or has nothing to do. Render thread; no side effects but LogOnce.
	FPassRays (*ChooseRays)(const FPassQuery& Query);
	/// Adds the pass and returns its output. Invalid: ChooseRays chose no path, or shaders are still being compiled.
	FGraphTexture (*Add)(FFrameContext& Context, const FGBuffer& GBuffer);
	/// Whether the pass, if it runs, follows how objects moved (FSceneConstants::ObjectMotions). Null: it does not.
	bool (*WantsMotion)(const FRTScene& Scene) = nullptr;
	/// With WantsMotion: it follows what rays met, which no motion vectors of a host tell.
	bool bFollowsHits = false;
	/// Lists the compute shaders of the filter behind the pass, if it runs. Null: it has none.
	void (*ListFilters)(const FRTScene& Scene, const FPassQuery& Query, std::vector<FShaderSource>& Out) = nullptr;
	/// A signal that serves in its place once its rays are ready. Count: there is none.
	ESignal ReplacedBy = ESignal::Count;
	/// A signal of whose rays this one is made. Its row asks for them, whether that signal is made or not. Count: this row does.
	ESignal RaysOf = ESignal::Count;
	/// The signal of local lights that holds directly seen emission of the same lobe (LocalLights/Emitters.h). Count: there is none.
	ESignal EmissionIn = ESignal::Count;
	/// Returns the path by which the pass keeps radiance cells up to date, if its rays are asked for. None, or null: it keeps none.
	ERayPath (*KeepsRadianceCells)(const FPassQuery& Query) = nullptr;
	/// Adds what the signal asks of the frame's shadow rays (RequireShadowRays). Called if ChooseRays chose the queue's shaders, and they
	/// are ready: Dispatch has them. False: it asks for nothing, because its other shaders are not. Null: it never asks.
	bool (*AskShadowRays)(FFrameContext& Context, const FRayDispatch& Dispatch, FShadowRayWishes& InOut) = nullptr;
	/// Whether the half frame asks for them (HalfFrame/HalfFrame.h). Null: the whole one does.
	bool (*IsHalf)(const FFrameContext& Context) = nullptr;
	/// The signal holds what is not in the light mask, if a frame has one. The first such row asks for the rays of the mask.
	bool bBesideLightMask = false;
	/// Its surfaces are those of RequireToonSurface (Toon/Toon.h).
	bool bStyled = false;
	/// Returns the surfaces of the signal's reference, of the G-buffer. Null: the G-buffer itself, or as bStyled says.
	FGBuffer (*AddSurface)(FFrameContext& Context, const FGBuffer& GBuffer) = nullptr;
	/// Lists the shaders of AddSurface. Null: none.
	void (*ListSurfaceShaders)(const FSceneFacts& Facts, std::vector<FShaderSource>& Out) = nullptr;
	/// It shows what AddToonGrade makes of its light.
	bool bToonGraded = false;
	/// Fills what the signal's reference reads of the constants beside the rest. Null: nothing.
	void (*SetReferenceConstants)(FReferenceConstants& Constants) = nullptr;
	/// Names of pictures that the pass draws of how it works, for r.RT.Debug.View, with a null behind the last one. Null: none.
	const char* const* Pictures = nullptr;
};

/// Returns how Signal is made. Signal: neither Frame nor Count.
const FSignalPass& GetSignalPass(ESignal Signal);

/// Returns whether a frame makes Signal at all: see FSignalRequests::bNothingElse.
inline bool IsMade(ESignal Signal, const FSignalRequests& Requests) { return !Requests.bNothingElse || Requests.Wanted.Has(Signal); }

/// Returns the signal whose row asks for the rays of the light mask, and lists its shaders, whether the signal itself is made or not.
ESignal GetLightMaskRow();
/// Returns whether a frame asks for the rays of Signal's row.
bool AsksForRays(ESignal Signal, const FSignalRequests& Requests);
/// Returns the path by which a frame keeps radiance cells up to date, for passes that look them up. None: it has none.
ERayPath ChooseRadianceCellPath(const FPassQuery& Query);
/// Returns whether a frame makes some signal of what is not in the light mask.
bool IsAnyMadeBesideLightMask(const FSignalRequests& Requests);

/// Returns what Signal traces in this frame. Path None: nothing.
FPassRays ChooseSignalRays(const FFrameContext& Context, ESignal Signal);

/// Gives the signals that ask for shadow rays one shader, which has what any of them needs. Rays: of all signals.
void ShareQueueShader(std::array<FPassRays, SignalCount>& Rays);

/// Calls Visit(const FSignalPass&) for all signals but Frame.
template <class TVisit>
void ForEachSignalPass(TVisit&& Visit)
{
	for (size_t I = ToIndex(ESignal::Frame) + 1; I < SignalCount; ++I) { Visit(GetSignalPass(static_cast<ESignal>(I))); }
}

} // namespace Lantern
