// Renders frames on the mock device and lists the pipelines that they asked for.
#include "Bench/BenchShaderList.h"

#include <set>

#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/Text/Quote.h"
#include "LanternMeasure/Methods.h"

namespace Lantern
{

namespace
{
std::string NameOf(const FShaderSource& Source)
{
	std::string Name = Source.Path;
	for (const auto& [Define, Value] : Source.Defines) { Name += ' ' + Define + (Value == "1" ? "" : '=' + Value); }
	return Name;
}

class FPipelineLister
{
public:
	FPipelineLister(FSampleEngine& InEngine, std::vector<FPipelineShaders>& InOut) : Engine(InEngine), Out(InOut)
	{
		for (const FPipelineShaders& Known : Out) { Names.insert(Known.Name); }
	}

	/// What frames with the console variables as they are trace with, and dispatch so far.
	FRTStatus RenderAndAdd(const FFrameCapture& Capture)
	{
		constexpr uint32_t Size = 32;
		const FView View = Engine.GetScene().MakeDefaultView(Size, Size);
		// Accumulation over time needs a frame before.
		for (int Frame = 0; Frame < 2; ++Frame)
		{
			FCapturedFrame Unused;
			if (FRTStatus S = Engine.RenderFrame(View, Frame, Capture, &Unused); !S) { return S; }
		}
		FFrameFeatures Features;
		Features.Signals.Wanted = Capture.Signals;
		AddRays(Features);
		return FRTStatus::Success();
	}

	void AddReferences()
	{
		for (const FSignalInfo& Info : SignalInfos)
		{
			for (const bool bFromGBuffer : {false, true})
			{
				FFrameFeatures Features;
				Features.bReference = true;
				Features.ReferenceSignal = Info.Signal;
				Features.bReferenceFromGBuffer = bFromGBuffer;
				AddRays(Features);
			}
		}
	}

	void AddRaster(const std::string& Scene)
	{
		FPipelineShaders All;
		const std::vector<FRasterSource> Pipelines = Engine.GetRenderer().GetPipelines().GetRasterSources();
		for (const FRasterSource& Pipeline : Pipelines) { All.Shaders.insert(All.Shaders.end(), {Pipeline.Vertex, Pipeline.Fragment}); }
		All.Name = "GBuffer of " + EscapeText(Scene) + ", " + std::to_string(Pipelines.size()) + " pipelines";
		All.RasterScene = Scene;
		Add(std::move(All));
	}

	void AddCompute()
	{
		for (FShaderSource& Source : Engine.GetRenderer().GetPipelines().GetComputeSources())
		{
			FPipelineShaders Pipeline;
			Pipeline.Shaders = {std::move(Source)};
			Pipeline.Name = NameOf(Pipeline.Shaders.front());
			Add(std::move(Pipeline));
		}
	}

private:
	/// As frames have it: one pipeline for all ray generation shaders. Each of them alone, to say which is dear.
	void AddRays(const FFrameFeatures& Features)
	{
		FConsoleVariables::Get().BeginFrame();
		const FRTPSODesc All = Engine.GetRenderer().GetRayPrograms(Engine.GetScene().GetScene(), Features);
		std::string Name;
		for (const FShaderSource& RayGen : All.RayGens)
		{
			Name += (Name.empty() ? "" : ", ") + NameOf(RayGen);
			FRTPSODesc Alone = All;
			Alone.RayGens = {RayGen};
			AddPipeline(NameOf(RayGen), std::move(Alone));
		}
		if (All.RayGens.size() > 1) { AddPipeline(Name, All); }
	}

	void AddPipeline(const std::string& Name, FRTPSODesc Rays)
	{
		FPipelineShaders Pipeline;
		Pipeline.Rays = std::move(Rays);
		Pipeline.Programs = Engine.GetRenderer().GetPrograms();
		Pipeline.Shaders = ListShaders(Pipeline.Rays, Pipeline.Programs);
		Pipeline.Name = Name + " + " + std::to_string(Pipeline.Shaders.size() - Pipeline.Rays.RayGens.size());
		Add(std::move(Pipeline));
	}

	void Add(FPipelineShaders Pipeline)
	{
		if (Names.insert(Pipeline.Name).second) { Out.push_back(std::move(Pipeline)); }
	}

	FSampleEngine& Engine;
	std::vector<FPipelineShaders>& Out;
	std::set<std::string> Names;
};
} // namespace

FRTStatus ListPipelines(FSampleEngine& Engine, const std::string& Scene, const std::string& MethodsFile, std::vector<FPipelineShaders>& Out)
{
	// Shaders leave out what a scene does not have; a sun and a sky nearly all have.
	FSunLight Sun;
	Sun.Irradiance = 1.0f;
	Sun.AngularDiameter = 0.01f;
	Engine.GetScene().SetSun(Sun);
	Engine.GetScene().GetScene().SetSky(glm::vec3(1.0f));
	FPipelineLister Lister(Engine, Out);
	FFrameCapture Capture;
	Capture.bDisplay = Capture.bLighting = true;
	if (FRTStatus S = Lister.RenderAndAdd(Capture); !S) { return S; }
	Lister.AddReferences();
	const FMethods Methods = LoadMethods(MethodsFile);
	if (!Methods.Problems.empty() || Methods.Methods.empty())
	{
		const std::string Problem = Methods.Problems.empty() ? MethodsFile + ": no method is in it" : Methods.Problems.front();
		return FRTStatus::Error(ERTResult::IoError, "%s", Problem.c_str());
	}
	for (const FMethod& Method : Methods.Methods)
	{
		for (const FMethodPreset& Preset : Method.Presets)
		{
			FMethodScope Scope;
			if (const std::vector<std::string> Refused = Scope.Apply(Methods, &Method, &Preset); !Refused.empty())
			{
				return FRTStatus::Error(ERTResult::InvalidArgument, "%s", Refused.front().c_str());
			}
			FFrameCapture Signal;
			Signal.Signals.Add(Method.Signal);
			if (FRTStatus S = Lister.RenderAndAdd(Signal); !S) { return S; }
		}
	}
	Lister.AddRaster(Scene);
	Lister.AddCompute();
	return FRTStatus::Success();
}

} // namespace Lantern
