// What console variables and the host's features make of a frame, for BeginFrame and Precache alike. Render thread.
#pragma once

#include "LanternRenderer/Renderer.h"

namespace Lantern
{

/// Tells the scene what console variables say of its materials.
void ApplySceneVariables(FRTScene& Scene);
FSignalSet AllSignals();
/// Returns what the host asks for, and what r.RT.Debug.View shows.
FSignalRequests CompleteRequests(FSignalRequests Requests);
/// Returns the scene's facts with those of the frame. Requests: of CompleteRequests.
FSceneFacts AddFrameFacts(FSceneFacts Facts, const FFrameFeatures& Features, const FSignalRequests& Requests);
/// Whether a frame waits until all of its shaders are compiled.
bool WaitsForPipelines(const FFrameFeatures& Features);

} // namespace Lantern
