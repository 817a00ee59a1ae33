// Indirect light by brute force: paths from every pixel through one lobe of its surface. It is the baseline that every later
// method must beat. Paths of screen probes are launched in the same way.
#pragma once

#include "RayPath.h"

namespace Lantern
{

/// One signal's variables. Static storage.
struct FBruteForcePass
{
	ESignal Signal;
	const char* Variable;                       ///< name of what switches the pass
	bool (*IsOn)();                             ///< render thread
	const TRTConsoleVariable<int32_t>& Samples; ///< paths per pixel
	/// Surfaces that may reflect light before it reaches the one that is lit.
	const TRTConsoleVariable<int32_t>& Bounces;
	/// Rougher surfaces are not traced; null: all are.
	const TRTConsoleVariable<float>* MaxRoughness = nullptr;
	bool (*EndsInRadianceCells)() = [] { return false; }; ///< whether paths do; render thread
	/// Pixels that trace in a frame, as EPixelRate. The others are filled as diffuse light may be. Null: all trace.
	const TRTConsoleVariable<int32_t>* Rate = nullptr;
	/// As ChooseShadingRayPath has it. Null: the signal has no shader for ray queries.
	const TRTConsoleVariable<int32_t>* Path = nullptr;
	bool (*IsGuided)() = [] { return false; }; ///< whether paths of a white Lambert lobe follow a guide; render thread
	const char* What = "";                     ///< names the pass in messages, with Path
	/// For paths through a white Lambert lobe: the signal of the specular lobes that the same paths light, if LightsSecond says so. Base
	/// colour and material are then read. Count: there is none.
	ESignal Second = ESignal::Count;
	bool (*LightsSecond)(const FPassQuery& Query) = nullptr;
	/// Whether paths start at screen probes, which light the pixels around them. For white Lambert lobes; Rate and IsGuided do not count then.
	bool (*FromProbes)() = [] { return false; };
	/// Whether paths of pixels light the pixels around as well. For white Lambert lobes; does not count with probes.
	bool (*KeepsPaths)() = [] { return false; };
	/// Whether paths of a white Lambert lobe leave either side of what lets light through, where the G-buffer has BackAlbedo. Base colour and
	/// material are then read.
	bool bBothSides = false;
};

ERayPath ChooseBruteForcePath(const FBruteForcePass& Settings, const FPassQuery& Query);
FPassRays ChooseBruteForceRays(const FBruteForcePass& Settings, const FPassQuery& Query);
/// Returns the second launch of a pass with bRadianceCells, which follows the paths that the first has left.
FPassRays MakeDeferredRays(ESignal Signal, const FPassRays& Rays);
/// What AddBruteForcePass has made. Invalid: nothing is traced, or shaders are being compiled.
struct FBruteForceOutputs
{
	FGraphTexture Lobe;       ///< of FBruteForcePass::Signal
	FGraphTexture Second;     ///< of FBruteForcePass::Second, over the albedo of that lobe
	bool bKnownNoise = false; ///< of either, see FDenoiseInputs
	FGraphBuffer Changes;     ///< see AddPathResolve
};
/// Reads Depth and Normals of the G-buffer, and BaseColor and Material if FSignalInfo::bNeedsSurface of either signal says so.
FBruteForceOutputs AddBruteForcePass(const FBruteForcePass& Settings, FFrameContext& Context, const FGBuffer& GBuffer);

} // namespace Lantern
