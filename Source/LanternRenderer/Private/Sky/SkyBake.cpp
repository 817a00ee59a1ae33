// The sky's map: which tiles a frame bakes, and how the map that is shown follows.
#include "Sky/SkyBake.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/Text/Log.h"
#include "LanternRenderer/SkyProgram.h"
#include "LanternScene/Memory/Upload.h"
#include "LanternScene/Scene/TextureSlot.h"
#include "ShaderReplacement.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarBake("r.RT.Sky.Bake", true,
    "Rays that leave the scene read the sky's program from a map. Off: each ray runs the program, as the reference does. Skies without a "
    "program have no map.");
TRTConsoleVariable<int32_t> CVarSize(
    "r.RT.Sky.Size", 1536, "Texels of the sky's map in each direction. The map is octahedral.", {SKY_TILE_SIZE, 8192});
TRTConsoleVariable<float> CVarRefreshSeconds("r.RT.Sky.RefreshSeconds", 4.0f,
    "Time, in seconds, in which the sky's map is baked anew while clouds drift. A change of sun or host by more than 2 % is baked at once. "
    "0: each frame bakes all of it, without a fade.",
    {0, 3600});
TRTConsoleVariable<float> CVarFadeSeconds("r.RT.Sky.FadeSeconds", 0.25f,
    "Time, in seconds, in which rays go from the sky's old map to its new one; half of r.RT.Sky.RefreshSeconds at most.", {0, 60});
TRTConsoleVariable<bool> CVarDebugFade(
    "r.RT.Debug.Sky.Fade", true, "Planted fault. Off: rays see the sky's new map from one frame to the next.");

constexpr double JumpChange = 0.02; // of sun or host
constexpr uint32_t IdleFrames = 8;  // of the view that keeps the time, after which another one does

FShaderSource MakeBakeSource() { return MakeComputeSource("Sky/Bake.comp"); }
FShaderSource MakeFadeSource() { return MakeComputeSource("Sky/Fade.comp"); }

/// As part of the longer one. Numbers that are about 0 beside others do not count as changed by all of themselves.
template <class T>
double GetRelativeChange(const T& A, const T& B)
{
	const double Longer = std::max(double(glm::length(A)), double(glm::length(B)));
	return Longer > 0.0 ? double(glm::length(A - B)) / Longer : 0.0;
}

double GetValuesChange(const glm::vec4* A, const glm::vec4* B)
{
	double Change = 0.0;
	for (int I = 0; I < SKY_PROGRAM_VALUES; ++I) { Change = std::max(Change, GetRelativeChange(A[I], B[I])); }
	return Change;
}

double GetAxesChange(const glm::vec3* A, const glm::vec3* B)
{
	double Change = 0.0;
	for (int I = 0; I < 3; ++I) { Change = std::max(Change, double(glm::length(A[I] - B[I]))); }
	return std::min(Change, 1.0);
}

uint32_t CountTiles(uint32_t Size)
{
	const uint32_t InRow = DivideUp(Size, SKY_TILE_SIZE);
	return InRow * InRow;
}
} // namespace

FShaderHeader MakeSkyProgramHeader(const std::string& Path) { return MakeShaderReplacement("Sky/SkyProgram.glsl", Path); }

bool IsSkyBaked() { return CVarBake.GetOnRenderThread(); }

double GetSkyChange(const FSkyData& Before, const FSkyData& Now)
{
	double Change = std::max(
	    {GetValuesChange(Before.Values, Now.Values), GetAxesChange(Before.Axes, Now.Axes), double(glm::length(Before.ToSun - Now.ToSun))});
	Change =
	    std::max({Change, GetRelativeChange(Before.SunIrradiance, Now.SunIrradiance), GetRelativeChange(Before.Radiance, Now.Radiance)});
	return std::min(Change, 1.0);
}

void ListSkyShaders(const FSceneFacts& Facts, std::vector<FShaderSource>& Out)
{
	if (!Facts.bSkyProgram || !IsSkyBaked()) { return; }
	Out.push_back(MakeBakeSource());
	Out.push_back(MakeFadeSource());
}

void FSkyBake::Free()
{
	Baked = Shown = {};
	Done = 1.0;
	FadeLeft = Leap = 0.0;
}

FRTStatus FSkyBake::CreateMap(const char* Name, uint32_t Size, FMap& Out)
{
	FRTTextureDesc Desc;
	Desc.Width = Desc.Height = Size;
	Desc.Format = ERTFormat::RGBA16_FLOAT;
	Desc.Usage = ERTTextureUsage::Sampled | ERTTextureUsage::Storage;
	Desc.Name = Name;
	Out = {};
	return Device.CreateTexture(Desc, Out.Texture.ReleaseAndGetAddress());
}

FRTStatus FSkyBake::Prepare(uint32_t Size)
{
	if (Shown.Texture && Shown.Texture->GetDesc().Width == Size) { return FRTStatus::Success(); }
	Free();
	FRTStatus Status;
	if (!Sampler)
	{
		FRTSamplerDesc Desc;
		Desc.U = Desc.V = ERTAddress::Clamp;
		Desc.Name = "Sky";
		Status = Device.CreateSampler(Desc, Sampler.ReleaseAndGetAddress());
	}
	if (Status) { Status = CreateMap("SkyBaked", Size, Baked); }
	if (Status) { Status = CreateMap("SkyShown", Size, Shown); }
	if (!Status) { Free(); }
	return Status;
}

/// The time of several views of a frame must not add up.
bool FSkyBake::TakesTurn(const FFrameContext& Context, uint32_t ViewIndex)
{
	const uint32_t Frame = Context.View.FrameIndex;
	if (ViewIndex != TurnView && Frame - TurnFrame < IdleFrames && Shown.bWritten) { return false; }
	TurnView = ViewIndex;
	TurnFrame = Frame;
	return true;
}

FSkyBake::FStep FSkyBake::Advance(const FSkyData& Now, const FView& View)
{
	FStep Step;
	const double Delta = double(View.DeltaSeconds), Refresh = CVarRefreshSeconds.GetOnRenderThread();
	const uint32_t Tiles = CountTiles(Shown.Texture->GetDesc().Width);
	const double Wanted = CVarDebugFade.GetOnRenderThread() ? double(CVarFadeSeconds.GetOnRenderThread()) : 0.0;
	const double Fade = std::min(Wanted, 0.5 * Refresh); // the rest is for the tiles
	const bool bLeapt = std::abs(double(Now.Seconds) - double(Round.Seconds)) > 2.0 * Refresh + 1.0;
	const double Differs = bLeapt || !Baked.bWritten ? 1.0 : GetSkyChange(Round, Now);
	const bool bWhole = Differs > JumpChange || Refresh <= 0.0, bIdle = Done >= 1.0 && FadeLeft <= 0.0;
	if (Differs > JumpChange || ((bIdle || bWhole) && std::memcmp(&Round, &Now, sizeof(Now)) != 0))
	{
		Round = Now;
		Done = 0.0;
		Leap = Differs > JumpChange ? Differs : 0.0;
	}
	if (Done < 1.0)
	{
		const double Before = Done;
		Done = bWhole ? 1.0 : std::min(Done + Delta / (Refresh - Fade), 1.0);
		Step.FirstTile = static_cast<uint32_t>(Before * Tiles);
		Step.TileCount = static_cast<uint32_t>(Done * Tiles) - Step.FirstTile;
		if (Done >= 1.0) { FadeLeft = std::max(Fade, 1.0e-6); }
	}
	if (Done >= 1.0 && FadeLeft > 0.0)
	{
		Step.Fade = Shown.bWritten && !View.bCut ? static_cast<float>(std::min(Delta / FadeLeft, 1.0)) : 1.0f;
		FadeLeft = Step.Fade >= 1.0f ? 0.0 : FadeLeft - Delta;
	}
	return Step;
}

FRTStatus FSkyBake::AddBakePass(
    FFrameContext& Context, FFrameUploads& Uploads, IRTPipeline* Pipeline, const FStep& Step, FGraphTexture Target)
{
	FUploadSlice Slice;
	if (FRTStatus S = Uploads.Push(&Round, sizeof(Round), Slice); !S) { return S; }
	const uint32_t Size = Baked.Texture->GetDesc().Width;
	Context.Graph.AddPass("SkyBake", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Write(Target, ERTAccess::StorageWrite);
		Context.Tokens.LeaveAlone(Builder);
		return [=](FPassContext& Pass) {
			FSkyBakeConstants C{};
			C.Sky = Slice.Address;
			C.Output = Pass.GetTexture(Target)->GetStorageIndex();
			C.Size = Size;
			C.FirstTile = Step.FirstTile;
			Pass.Commands().SetPipeline(Pipeline);
			Pass.Commands().PushConstants(&C, sizeof(C));
			Pass.Commands().Dispatch(SKY_TILE_SIZE / SKY_GROUP_SIZE, SKY_TILE_SIZE / SKY_GROUP_SIZE, Step.TileCount);
		};
	});
	Baked.bWritten = true;
	return FRTStatus::Success();
}

void FSkyBake::AddFadePass(FFrameContext& Context, IRTPipeline* Pipeline, float Share, FGraphTexture From, FGraphTexture Target)
{
	const uint32_t Size = Shown.Texture->GetDesc().Width;
	Context.Graph.AddPass("SkyFade", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(From, ERTAccess::ShaderRead);
		if (Share < 1.0f) { Builder.Read(Target, ERTAccess::StorageRead); }
		Builder.Write(Target, ERTAccess::StorageWrite);
		Context.Tokens.LeaveAlone(Builder);
		return [=](FPassContext& Pass) {
			FSkyFadeConstants C{};
			C.Baked = GetSampledIndex(Pass, From);
			C.Shown = GetStorageIndex(Pass, Target);
			C.Size = Size;
			C.Share = Share;
			Dispatch2D(Pass, Pipeline, C, Size, Size, SKY_GROUP_SIZE);
		};
	});
	// Later passes read the map without the graph.
	Context.Graph.AddPass("SkyReady", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.NeverCull();
		Builder.Read(Target, ERTAccess::ShaderRead);
		Context.Tokens.WriteAlone(Builder, Context.Tokens.Sky);
		return [](FPassContext&) {};
	});
	Shown.bWritten = true;
}

FRTStatus FSkyBake::AddPasses(FFrameContext& Context, FFrameUploads& Uploads, uint32_t ViewIndex, bool bRead)
{
	Data = 0;
	bUsed = false;
	const uint64_t World = Context.Scene.GetSections().GetIdentity();
	if (!Context.Facts.bSkyProgram || World != LastWorld) { Free(); }
	LastWorld = World;
	if (!Context.Facts.bSkyProgram) { return FRTStatus::Success(); }
	const FSkyData Now = Context.Scene.MakeSkyData();
	FUploadSlice Slice;
	if (FRTStatus S = Uploads.Push(&Now, sizeof(Now), Slice); !S) { return S; }
	Data = Slice.Address;
	bUsed = Shown.bWritten; // also where shaders run the program: those of the frame before may stand in
	const FSkyData Before = std::exchange(Last, Now);
	if (Context.Facts.bSkyInPlace) { Context.World->SkyChange = GetSkyChange(Before, Now); }
	if (Context.Facts.bSkyInPlace || !bRead) { return FRTStatus::Success(); }
	if (TakesTurn(Context, ViewIndex)) { return AddMapPasses(Context, Uploads, Now); }
	Context.World->SkyChange = Change;
	return FRTStatus::Success();
}

FRTStatus FSkyBake::AddMapPasses(FFrameContext& Context, FFrameUploads& Uploads, const FSkyData& Now)
{
	IRTPipeline* const Bake = RequireCompute(Context, MakeBakeSource());
	IRTPipeline* const Fade = RequireCompute(Context, MakeFadeSource());
	FRTStatus Status;
	if (Bake && Fade) { Status = Prepare(static_cast<uint32_t>(CVarSize.GetOnRenderThread())); }
	if (Status.Code == ERTResult::DeviceLost) { return Status; }
	if (!Status) { LogOnce(ERTLogLevel::Warning, std::string("the sky's program has no map: ") + Status.Message); }
	if (!Bake || !Fade || !Status)
	{
		// As if there were no program: later passes must not need it either.
		Context.Facts.bSkyProgram = bUsed = false;
		Context.Facts.bSkyMap = Context.Facts.bSky && Context.Scene.GetConstants().SkyMap != NO_TEXTURE;
		return FRTStatus::Success();
	}
	const FStep Step = Advance(Now, Context.View);
	Context.World->SkyChange = Change = Leap * double(Step.Fade);
	bUsed = true;
	if (Step.TileCount == 0 && Step.Fade <= 0.0f) { return FRTStatus::Success(); }
	const auto Import = [&](const FMap& Map, const char* Name) {
		return Context.Graph.ImportTexture(
		    Map.Texture.Get(), Map.bWritten ? ERTAccess::ShaderRead : ERTAccess::None, ERTAccess::ShaderRead, Name);
	};
	const FGraphTexture Target = Import(Baked, "SkyBaked");
	if (Step.TileCount > 0) { Status = AddBakePass(Context, Uploads, Bake, Step, Target); }
	if (Status && Step.Fade > 0.0f) { AddFadePass(Context, Fade, Step.Fade, Target, Import(Shown, "SkyShown")); }
	return Status;
}

void FSkyBake::FillConstants(FSceneConstants& InOut) const
{
	InOut.SkyData = Data;
	if (!bUsed || !Shown.bWritten) { return; }
	if (!MakeTextureSlot(Shown.Texture->GetSampledIndex(), Sampler->GetIndex(), InOut.SkyMap)) { return; }
	InOut.SkyMapKind = SKY_MAP_ROOTS;
	for (int Row = 0; Row < 3; ++Row) { InOut.SkyMapAxes[Row] = glm::vec3(Row == 0, Row == 1, Row == 2); }
}

void FSkyBake::EndFrame(bool bSubmitted)
{
	if (!bSubmitted) { Free(); }
}

} // namespace Lantern
