// The host's shadow map: its constants, and the pass that makes the pyramid.
#include "Tiles/HostShadow.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "Rays/RayQueue.h"
#include "ShaderReplacement.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<float> CVarTexelPixels("r.RT.Shadow.HostMap.TexelPixels", 1.0f,
    "Largest texel of the host's shadow map, in pixels, whose word counts for a lit surface. Rays are traced where texels are larger, "
    "because the map may miss what is thin. 0: rays are traced for all lit surfaces.",
    {0, 1e9});
TRTConsoleVariable<bool> CVarHeld("r.RT.Debug.Shadow.HostMap.Held", true,
    "Planted fault. Off: rays trace what the host's shadow map holds as well, so that penumbrae are shadowed twice.");

constexpr const char* Replaced = "Tiles/HostShadow.glsl";

uint32_t GetHeld(const FHostShadow& Host) { return CVarHeld.GetOnRenderThread() ? Host.Held : HOST_SHADOW_OTHERS; }

struct FAllData
{
	FHostShadowData Data{};
	FHostShadowCascadeData Cascades[HOST_SHADOW_CASCADES]{};
};

struct FLevels
{
	uint32_t First[HOST_SHADOW_LEVELS] = {}; // cells
	uint32_t Top = HOST_SHADOW_FIRST_LEVEL;
	uint32_t Cells = 0;
};

FLevels CountLevels(uint32_t Width, uint32_t Height)
{
	FLevels Levels;
	for (uint32_t Level = HOST_SHADOW_FIRST_LEVEL; Level < HOST_SHADOW_LEVELS; ++Level)
	{
		const uint32_t Across = DivideUp(Width, 1u << Level), Down = DivideUp(Height, 1u << Level);
		Levels.First[Level] = Levels.Cells;
		Levels.Cells += Across * Down;
		Levels.Top = Level;
		if (Across * Down == 1) { break; }
	}
	return Levels;
}

/// The tangent of the angle by which rays to the sun may lean against the map's own direction.
double GetSpread(const FSunLight& Sun, float Diameter, const glm::dvec3& MapDirection)
{
	const double Radius = 0.5 * double(Diameter);
	const glm::dvec3 Direction = glm::normalize(glm::dvec3(Sun.Direction));
	const double Lean = std::atan2(glm::length(glm::cross(Direction, MapDirection)), glm::dot(Direction, MapDirection));
	// Rounding of the host's matrix is no angle.
	return std::tan(std::min(Radius + (Lean > 1e-5 ? Lean : 0.0), 1.5));
}

FHostShadowCascadeData MakeCascade(const FHostShadowCascade& From, const FFrameContext& Frame, float Diameter)
{
	glm::dmat3 Linear; // columns are the map's rows
	glm::dvec3 Offset;
	const double Size[3] = {double(From.Width), double(From.Height), 1.0};
	for (int Row = 0; Row < 3; ++Row)
	{
		Linear[Row] = glm::dvec3(From.WorldToMap[4 * Row], From.WorldToMap[4 * Row + 1], From.WorldToMap[4 * Row + 2]) * Size[Row];
		Offset[Row] = From.WorldToMap[4 * Row + 3] * Size[Row] + glm::dot(Linear[Row], Frame.View.Position);
	}
	const FSunLight& Sun = Frame.Scene.GetSun();
	const bool bReversed = glm::dot(Linear[2], glm::dvec3(Sun.Direction)) < 0.0;
	const double MetersPerDepth = (bReversed ? -1.0 : 1.0) / glm::length(Linear[2]), Near = bReversed ? 1.0 : 0.0;
	Linear[2] *= MetersPerDepth;
	Offset[2] = (Offset[2] - Near) * MetersPerDepth;
	FHostShadowCascadeData Out{};
	const glm::dmat3 Normals = glm::transpose(glm::inverse(Linear)); // columns are the rows of the inverse transpose
	for (int Row = 0; Row < 3; ++Row)
	{
		Out.ToMap[Row] = glm::vec4(Linear[Row], Offset[Row]);
		Out.NormalToMap[Row] = glm::vec3(Normals[Row]);
	}
	Out.DepthScale = static_cast<float>(MetersPerDepth);
	Out.NearDepth = static_cast<float>(Near);
	Out.TexelSize = From.TexelSize;
	Out.Bias = From.DepthBias;
	const double TexelsPerMeter = std::max(glm::length(Linear[0]), glm::length(Linear[1]));
	Out.SpreadTexels = static_cast<float>(GetSpread(Sun, Diameter, Linear[2]) * TexelsPerMeter);
	Out.FirstX = From.OffsetX;
	Out.FirstY = From.OffsetY;
	Out.Width = From.Width;
	Out.Height = From.Height;
	return Out;
}
} // namespace

FShaderHeader MakeHostShadowHeader(const std::string& Path) { return MakeShaderReplacement(Replaced, Path); }

bool HasHostShadowHeader(const std::vector<FShaderHeader>& Headers)
{
	return std::ranges::any_of(Headers, [](const FShaderHeader& Header) { return Header.Include == Replaced; });
}

FShaderSource MakePyramidSource() { return MakeComputeSource("Tiles/Pyramid.comp"); }

FShaderDefines MakeHostShadowDefines(const FSceneFacts& Facts)
{
	return Facts.bHostShadow ? FShaderDefines{{"HAS_HOST_SHADOW", "1"}} : FShaderDefines();
}

void FHostShadowMap::Read(FPassBuilder& Builder) const
{
	for (uint32_t I = 0; I < Host.CascadeCount; ++I) { Builder.Read(Host.Cascades[I].Map, ERTAccess::ShaderRead); }
	if (Pyramid.IsValid()) { Builder.Read(Pyramid, ERTAccess::ShaderRead); }
}

FAddress FHostShadowMap::Push(FPassContext& Pass, const FFrameContext& Frame) const
{
	if (!IsValid() || Host.CascadeCount == 0) { return Host.ShaderData; }
	FAllData All;
	FAddress Cells = Pass.GetBuffer(Pyramid)->GetDeviceAddress();
	for (uint32_t I = 0; I < Host.CascadeCount; ++I)
	{
		FHostShadowCascadeData& Cascade = All.Cascades[I] = MakeCascade(Host.Cascades[I], Frame, Diameter);
		const FLevels Levels = CountLevels(Cascade.Width, Cascade.Height);
		std::copy(std::begin(Levels.First), std::end(Levels.First), Cascade.Levels);
		Cascade.TopLevel = Levels.Top;
		Cascade.Map = Pass.GetTexture(Host.Cascades[I].Map)->GetSampledIndex();
		Cascade.Pyramid = Cells;
		Cells += uint64_t(Levels.Cells) * sizeof(vec2);
	}
	All.Data.CascadeCount = Host.CascadeCount;
	All.Data.bKept = (GetHeld(Host) & HOST_SHADOW_OTHERS) != 0 ? 1u : 0u;
	All.Data.TexelPixels = CVarTexelPixels.GetOnRenderThread();
	FUploadSlice Slice;
	if (const FRTStatus Status = Frame.Owner->GetUploads().Allocate(sizeof(All), Slice); !Status)
	{
		Frame.Fail(Status);
		return 0;
	}
	All.Data.Cascades = Slice.Address + offsetof(FAllData, Cascades);
	std::memcpy(Slice.Data, &All, sizeof(All));
	return Slice.Address;
}

namespace
{
/// Regions of the whole texture get its size.
void CompleteRegions(const FFrameGraph& Graph, FHostShadow& Host)
{
	assert(Host.CascadeCount <= HOST_SHADOW_CASCADES && (Host.Held & ~(MASK_SUN_CASTERS | HOST_SHADOW_OTHERS)) == 0);
	for (uint32_t I = 0; I < Host.CascadeCount; ++I)
	{
		FHostShadowCascade& Cascade = Host.Cascades[I];
		const FGraphTextureDesc& Texture = Graph.GetDesc(Cascade.Map);
		if (Cascade.Width == 0) { Cascade.Width = Texture.Width - Cascade.OffsetX; }
		if (Cascade.Height == 0) { Cascade.Height = Texture.Height - Cascade.OffsetY; }
		assert(Cascade.TexelSize > 0.0f && Cascade.DepthBias >= 0.0f);
		assert(Cascade.OffsetX + Cascade.Width <= Texture.Width && Cascade.OffsetY + Cascade.Height <= Texture.Height);
	}
}

void DispatchLevels(FPassContext& Pass, IRTPipeline* Pipeline, FAddress Data, const FHostShadow& Host, IRTBuffer* Cells)
{
	uint32_t Across = 0, Down = 0, Top = 0;
	for (uint32_t I = 0; I < Host.CascadeCount; ++I)
	{
		Across = std::max(Across, Host.Cascades[I].Width);
		Down = std::max(Down, Host.Cascades[I].Height);
		Top = std::max(Top, CountLevels(Host.Cascades[I].Width, Host.Cascades[I].Height).Top);
	}
	Pass.Commands().SetPipeline(Pipeline);
	// The first level that is made, from one that has been.
	for (uint32_t Level = HOST_SHADOW_FIRST_LEVEL; Level <= Top; Level += HOST_SHADOW_GROUP_LEVELS)
	{
		const FPyramidConstants C{Data, Level == HOST_SHADOW_FIRST_LEVEL ? 0u : Level - 1, 0};
		if (C.InputLevel != 0)
		{
			const FRTBarrier Made{Cells, nullptr, ERTAccess::StorageWrite, ERTAccess::StorageWrite};
			Pass.Commands().Barriers(&Made, 1);
		}
		Pass.Commands().PushConstants(&C, sizeof(C));
		const uint32_t Texels = HOST_SHADOW_GROUP_SIZE << Level;
		Pass.Commands().Dispatch(DivideUp(Across, Texels), DivideUp(Down, Texels), Host.CascadeCount);
	}
}
} // namespace

FHostShadowMap AddHostShadowPass(FFrameContext& Context, FSunRays& Rays)
{
	Rays.LitMask = Rays.InstanceMask;
	FHostShadowMap Map;
	if (!Context.Facts.bHostShadow || !Context.HostShadow.IsGiven()) { return Map; }
	IRTPipeline* const Pipeline = Context.HostShadow.CascadeCount > 0 ? RequireCompute(Context, MakePyramidSource()) : nullptr;
	if (!Pipeline && Context.HostShadow.CascadeCount > 0) { return Map; }
	Map.Host = Context.HostShadow;
	Map.Diameter = Rays.Diameter;
	// Rays add what is not on the map where it is lit. Where it is unsure they trace all, unless they cannot.
	const uint32_t Held = GetHeld(Map.Host);
	Rays.LitMask = Rays.InstanceMask & ~Held;
	if ((Held & HOST_SHADOW_OTHERS) != 0) { Rays.InstanceMask = Rays.LitMask; }
	if (!Pipeline) { return Map; }
	CompleteRegions(Context.Graph, Map.Host);
	uint64_t Cells = 0;
	for (uint32_t I = 0; I < Map.Host.CascadeCount; ++I)
	{
		Cells += CountLevels(Map.Host.Cascades[I].Width, Map.Host.Cascades[I].Height).Cells;
	}
	Map.Pyramid = Context.Graph.CreateBuffer({Cells * sizeof(vec2)}, "HostShadowPyramid");
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass("HostShadowPyramid", [&](FPassBuilder& Builder) -> FPassExecute {
		for (uint32_t I = 0; I < Map.Host.CascadeCount; ++I) { Builder.Read(Map.Host.Cascades[I].Map, ERTAccess::ShaderRead); }
		Builder.Write(Map.Pyramid, ERTAccess::StorageWrite);
		Context.Tokens.LeaveAlone(Builder);
		return [=](FPassContext& Pass) {
			if (const FAddress Data = Map.Push(Pass, *Frame); Data != 0)
			{
				DispatchLevels(Pass, Pipeline, Data, Map.Host, Pass.GetBuffer(Map.Pyramid));
			}
		};
	});
	return Map;
}

} // namespace Lantern
