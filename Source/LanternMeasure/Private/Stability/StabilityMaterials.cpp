// Case 26, missing shaders: materials whose programs arrive while frames are rendered, some of which never compile.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include <fmt/format.h>

#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/Text/Log.h"
#include "LanternMeasure/GeneratedMaterials.h"
#include "LanternMeasure/MaterialWall.h"
#include "LanternMeasure/Stability/StabilityStage.h"
#include "Stability/StabilityFigures.h"

namespace Lantern
{

namespace
{
constexpr uint32_t Columns = 20, Rows = 10, PixelsPerQuad = 4;
constexpr uint32_t Width = Columns * PixelsPerQuad, Height = Rows * PixelsPerQuad;

/// Red and green are the material's, blue is the program's.
FMaterialProgramDesc MakeProgram(uint32_t Index, uint64_t Salt)
{
	FMaterialProgramDesc Desc;
	Desc.Name = fmt::format("Stability{}", Index);
	if (Index % 10 == 9)
	{
		Desc.Text = fmt::format("this is not GLSL {} {}\n", Index, Salt);
		return Desc;
	}
	Desc.Text = fmt::format("#include \"Materials/Standard.glsl\"\n// {}\n"
	                        "FMaterialSurface EvaluateMaterial(FMaterialData M, FMaterialInputs I, uint Override)\n"
	                        "{{\n\tFMaterialSurface S = EvaluateStandard(M, I, Override);\n\tS.BaseColor.b = {:.6f};\n\treturn S;\n}}\n",
	    Salt, 0.6 + Index / 1024.0);
	return Desc;
}

class FMaterialFrames
{
public:
	explicit FMaterialFrames(FStabilityStage& InStage) : Stage(InStage), Renderer(InStage.GetEngine().GetRenderer()) {}
	FRTStatus Frame(double& OutMs);
	FRTScene& GetScene() { return Stage.GetScene().GetScene(); }
	FRenderer& GetRenderer() { return Renderer; }
	/// Whether the last frame was traced. If not, there was no pipeline yet.
	bool HasPicture() const { return !Picture.empty(); }
	/// Colour and distance in the middle of a quad, in the last frame.
	glm::vec4 At(uint32_t Quad) const
	{
		return Picture[size_t(Quad / Columns * PixelsPerQuad + 2) * Width + Quad % Columns * PixelsPerQuad + 2];
	}
	FImage MakeImage() const;

private:
	FStabilityStage& Stage;
	FRenderer& Renderer;
	std::vector<glm::vec4> Picture;
};

FRTStatus FMaterialFrames::Frame(double& OutMs)
{
	TRTRef<IRTBuffer> Buffer;
	const FRTBufferDesc Desc{uint64_t(Width) * Height * sizeof(glm::vec4), ERTBufferUsage::CopyDest, ERTMemory::Readback, "Trace"};
	if (FRTStatus S = Renderer.GetDevice().CreateBuffer(Desc, Buffer.ReleaseAndGetAddress()); !S) { return S; }
	FFrameFeatures Features;
	Features.bWaitForPipelines = false;
	Features.bRays = true;
	Features.RayGens = {MakeMaterialTrace({.Path = "Stability/Trace.rgen", .RaysPerMetre = PixelsPerQuad})};
	const auto Start = std::chrono::steady_clock::now();
	FConsoleVariables::Get().BeginFrame();
	if (FRTStatus S = Renderer.BeginFrame(GetScene(), Stage.MakeView(), Features); !S) { return S; }
	FFrameContext& Context = Renderer.GetContext();
	const uint32_t RayGen = Context.RayPipeline ? Context.RayPipeline->FindRayGen(Features.RayGens[0]) : NoRayGen;
	if (RayGen != NoRayGen) { AddMaterialTraceReadback(Context, RayGen, Width, Height, Buffer.Get()); }
	if (FRTStatus S = Renderer.EndFrame(nullptr); !S) { return S; }
	OutMs = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - Start).count();
	if (FRTStatus S = Renderer.WaitForAll(); !S) { return S; }
	// A host waits for its display; without that, one on two cores leaves compilers nothing.
	std::this_thread::sleep_until(Start + std::chrono::milliseconds(8));
	Picture.clear();
	if (RayGen == NoRayGen) { return FRTStatus::Success(); }
	const auto* const Texels = static_cast<const glm::vec4*>(Buffer->GetMapped());
	Picture.assign(Texels, Texels + size_t(Width) * Height);
	return FRTStatus::Success();
}

FImage FMaterialFrames::MakeImage() const
{
	FImage Image(Width, Height, 3);
	for (size_t I = 0; I < Picture.size(); ++I)
	{
		for (int C = 0; C < 3; ++C) { Image.Pixels[3 * I + static_cast<size_t>(C)] = Picture[I][C]; }
	}
	return Image;
}

struct FMaterialCounts
{
	uint64_t Wrong = 0, Holes = 0;
	std::vector<double> Ms;
	uint32_t Ready = 0;
};

/// Each quad shows its own red and green always, and its program's blue or, until that is there, the stand-in's.
void CountQuads(
    const FMaterialFrames& Frames, const std::vector<FHitProgram>& Programs, const FRTPSO& Pipeline, bool bShifted, FMaterialCounts& Counts)
{
	Counts.Ready = 0;
	for (uint32_t Quad = 0; Quad < Columns * Rows; ++Quad)
	{
		const glm::vec4 Color = Frames.At(Quad);
		if (Color.a < 0.0f || (Color.r == 0.0f && Color.g == 0.0f && Color.b == 0.0f))
		{
			++Counts.Holes;
			continue;
		}
		const bool bOwn = Quad < Programs.size() && Pipeline.GetState(Programs[Quad]) == ERTHitState::Ready;
		const uint32_t Of = bShifted ? (Quad + 1) % (Columns * Rows) : Quad;
		const double Blue = bOwn ? 0.6 + Quad / 1024.0 : 0.5;
		const bool bRight = std::abs(Color.r - float(Of % Columns) / Columns) < 2e-3 &&
		                    std::abs(Color.g - float(Of / Columns) / Rows) < 2e-3 && std::abs(Color.b - Blue) < 2e-3;
		Counts.Wrong += bRight ? 0 : 1;
		Counts.Ready += bOwn ? 1 : 0;
	}
}

/// Says when what is not there will never come: nothing has been compiled or waited for in some frames running.
class FPatience
{
public:
	bool IsOver(bool bBusy)
	{
		constexpr uint32_t Enough = 300;
		Idle = bBusy ? 0 : Idle + 1;
		return Idle >= Enough;
	}

private:
	uint32_t Idle = 0;
};

double GetMedian(std::vector<double> Values)
{
	std::nth_element(Values.begin(), Values.begin() + Values.size() / 2, Values.end());
	return Values[Values.size() / 2];
}
} // namespace

/// 200 material programs (40 with --quick) arrive over 60 frames, every tenth of which does not compile; frames go on until
/// all others are there. Looked at in every frame. The time is the render thread's until the frame is submitted: on a CPU
/// device, where compiling and rendering share the cores, it is recorded without a limit.
FRTStatus MeasureMissingShaders(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out)
{
	if (FRTStatus S = Stage.Load("stability-materials"); !S) { return S; }
	FMaterialFrames Frames(Stage);
	if (!Frames.GetRenderer().GetDevice().GetCapabilities().bRayTracingPipeline)
	{
		return FRTStatus::Error(ERTResult::Unsupported, "no ray-tracing pipelines");
	}
	FMethodScope Skip; // long before: pipelines that were made with stand-ins serve until others are there
	if (Stage.IsFaulty() && !Skip.Apply({{"r.RT.Pipeline.Fallback", "0", "planted fault"}}).empty())
	{
		return FRTStatus::Error(ERTResult::InvalidArgument, "r.RT.Pipeline.Fallback");
	}
	FMaterialCounts Counts;
	double Ms = 0.0;
	FPatience Patience;
	const auto IsBusy = [&] { return Frames.GetRenderer().GetRayCompiler().GetStats().bBusy; };
	for (int I = 0; I < 60 || !Frames.HasPicture() || IsBusy(); ++I)
	{
		if (FRTStatus S = Frames.Frame(Ms); !S) { return S; }
		if (I >= 20) { Counts.Ms.push_back(Ms); }
		if (Patience.IsOver(IsBusy())) { return FRTStatus::Error(ERTResult::CompileFailed, "the standard material never came"); }
	}
	const double Idle = GetMedian(Counts.Ms);
	Counts.Ms.clear();
	const uint32_t Count = Stage.GetSettings().bQuick ? 40 : 200;
	const uint64_t Salt = MakeSalt();
	std::vector<FHitProgram> Programs;
	const uint32_t Compilable = Count - Count / 10;
	for (int I = 0; I < 60 || Counts.Ready < Compilable; ++I)
	{
		while (Programs.size() < std::min<size_t>(Count, Count * size_t(I + 1) / 60 + 1))
		{
			const auto Index = static_cast<uint32_t>(Programs.size());
			Programs.push_back({Frames.GetRenderer().GetPrograms().Add(MakeProgram(Index, Salt)), ERTHitClass::Opaque});
			Frames.GetScene().SetMaterialProgram(Index, Programs.back().Program);
		}
		if (FRTStatus S = Frames.Frame(Ms); !S) { return S; }
		Counts.Ms.push_back(Ms);
		if (Frames.HasPicture()) { CountQuads(Frames, Programs, *Frames.GetRenderer().GetRayPipeline(), Stage.IsFaulty(), Counts); }
		if (I == 30) { Stage.AddToStrip(Frames.MakeImage(), {}); }
		if (I % 500 == 499) { LogInfo("{} of {} material programs are there", Counts.Ready, Compilable); }
		if (Patience.IsOver(IsBusy()))
		{
			return FRTStatus::Error(ERTResult::CompileFailed, "%u of %u programs came", Counts.Ready, Compilable);
		}
		// As under the fault, where holes are what is looked for: it need not see the end.
		if (Stage.IsFaulty() && I >= 60) { break; }
	}
	Stage.AddToStrip(Frames.MakeImage(), {});
	for (uint32_t Index = 0; Index < Programs.size(); ++Index) { Frames.GetScene().SetMaterialProgram(Index, StandardProgram); }
	const bool bCpu = Frames.GetRenderer().GetDevice().GetCapabilities().bIsCpu;
	Out.push_back({"black holes", double(Counts.Holes), 0.0});
	Out.push_back({"wrong records", double(Counts.Wrong), 0.0});
	const double Worst = *std::max_element(Counts.Ms.begin(), Counts.Ms.end());
	Out.push_back(
	    {"longest frame above the median, ms", Worst - Idle, bCpu || Stage.IsFaulty() ? std::nullopt : std::optional<double>(2.0)});
	return FRTStatus::Success();
}

} // namespace Lantern
