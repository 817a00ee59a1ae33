// One scene of `lantern bench rays`: the plugin's sun shadows and the raw dispatch, in turn, over one G-buffer.
#pragma once

#include <string>
#include <vector>

#include "Bench/BenchTimes.h"
#include "LanternHost/SampleEngine.h"

namespace Lantern
{

struct FRayCase
{
	std::string Name;
	uint32_t Width = 0, Height = 0;
	uint64_t Rays = 0;       ///< number of pixels that trace a ray: no sky, no surface turned away from the sun
	double Agreement = 0;    ///< fraction of pixels on which the two agree
	FBenchTimes Raw, Plugin; ///< milliseconds; the plugin's are those of all passes that make the shadow
	FBenchTimes Queue;       ///< milliseconds: the part of Plugin that traces the queue
	/// Processor time of the same runs, in milliseconds. On a CPU driver its ratio holds where other programs disturb the times above.
	FBenchTimes RawProcessor, PluginProcessor;
	/// The pass that reads an engine's G-buffer with a far plane and without geometric normals, and the shadow pass behind it;
	/// milliseconds.
	FBenchTimes Surface, SurfaceShadow;
	double GetRawMrays() const; ///< by the median time
	double GetPluginMrays() const;
	double GetRatio() const { return GetPluginMrays() / GetRawMrays(); }
	double GetQueueRatio() const { return Raw.GetMedian() / Queue.GetMedian(); }
	double GetSurfaceShare() const { return Surface.GetMedian() / SurfaceShadow.GetMedian(); }
};

struct FRayBenchSettings
{
	uint32_t WarmUp = 3, Repetitions = 21;
	std::vector<std::string> ShaderFolders; ///< for the raw dispatch
	std::string CacheFolder;                ///< for its compiled shaders; empty: none
};

class FRawShadow;

class FRayBench
{
public:
	FRayBench(IRTDevice& InDevice, FSampleEngine& InEngine, FRayBenchSettings InSettings);

	/// Draws the G-buffer of View once and keeps it. The engine's scene must stay as it is until the last Measure.
	FRTStatus CaptureGBuffer(const FView& InView);
	/// Traces one ray per pixel, through ray-tracing pipelines or ray queries. The device must have them.
	FRTStatus Measure(bool bPipeline, FRayCase& Out);

private:
	FRTStatus CreateTargets();
	void AddCopies(FFrameContext& Context, const FGBuffer& GBuffer);
	struct FPluginMs
	{
		double All = 0.0, Rays = 0.0;
	};
	FRTStatus RunPlugin(FPluginMs& Out, double* OutSurfaceMs = nullptr);
	FRTStatus RunSurface(FRayCase& Out);
	FRTStatus CreateRaw(bool bPipeline, bool bCountRays, std::unique_ptr<FRawShadow>& Out);
	FRTStatus RunInTurn(FRawShadow& Raw, FRayCase& Out);

	IRTDevice& Device;
	FSampleEngine& Engine;
	FRayBenchSettings Settings;
	FShaderCompiler Compiler;
	FView View;
	TRTRef<IRTTexture> Depth, Normals;
	TRTRef<IRTBuffer> DepthBytes, NormalBytes, Visibility;
};

} // namespace Lantern
