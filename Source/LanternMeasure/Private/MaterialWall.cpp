// The wall of quads with a material each, and the passes that trace it.
#include "LanternMeasure/MaterialWall.h"

#include <fmt/format.h>

namespace Lantern
{

namespace
{
constexpr const char* TraceText = R"(#version 460
#extension GL_EXT_ray_tracing : require
#include "Library/View.glsl"
#include "Rays/MaterialPayload.glsl"

layout(set = 0, binding = 3) uniform accelerationStructureEXT Scenes[];
layout(push_constant, scalar) uniform FPush { FPassConstants Pass; uint Output; };
layout(location = 0) rayPayloadEXT FMaterialPayload Payload;
#ifdef CALLABLES
layout(location = 1) callableDataEXT vec3 Data;
#endif

void main()
{
	FSceneConstants Scene = FSceneRef(Pass.Scene).Data;
#ifdef RAYS_PER_METRE
	vec3 Origin = vec3((vec2(gl_LaunchIDEXT.xy) + 0.5) / RAYS_PER_METRE, 5.0), Direction = vec3(0.0, 0.0, -1.0);
#else
	FViewConstants View = FViewRef(Pass.View).Data;
	vec3 Origin = View.CameraPosition, Direction = normalize(CameraRay(View, vec2(gl_LaunchIDEXT.xy) + 0.5));
#endif
	Payload.W2 = 0u;
	traceRayEXT(Scenes[Scene.Tlas], 0u, MASK_VISIBLE, MATERIAL_RAY, RAY_TYPES, MATERIAL_MISS, Origin, 0.0, Direction, 1.0e30, 0);
	vec4 Color = Payload.Distance < 0.0 ? vec4(0.0, 0.0, 0.0, -1.0) : vec4(UnpackHit(Payload).BaseColor, Payload.Distance);
#ifdef CALLABLES
	Data = Color.rgb;
	executeCallableEXT(gl_LaunchIDEXT.x < gl_LaunchSizeEXT.x / 2 ? 0u : 1u, 1);
	Color.rgb = Data;
#endif
	imageStore(Images[Output], ivec2(gl_LaunchIDEXT.xy), Color);
}
)";

struct FTracePush
{
	FPassConstants Pass;
	uint32_t Output;
};
} // namespace

FSceneDescription MakeMaterialWall(const FMaterialWall& Wall)
{
	FSceneDescription Scene;
	Scene.Name = "Wall";
	FHostMesh Quad;
	Quad.Name = "Quad";
	const auto Size = static_cast<float>(Wall.QuadSize);
	for (const glm::vec2 Corner : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)})
	{
		Quad.Positions.emplace_back(Size * Corner, 0.0f);
		FVertexAttributes& Vertex = Quad.Attributes.emplace_back();
		Vertex.Color = ~0u;
		Vertex.UV0 = Corner;
	}
	Quad.Indices = {0, 1, 2, 0, 2, 3};
	Quad.Sections = {{0, 6, 0}};
	Quad.BoundsMin = {0, 0, 0};
	Quad.BoundsMax = {Size, Size, 0};
	Scene.Meshes.push_back(std::move(Quad));
	Scene.Materials.resize(Wall.Count);
	for (uint32_t Index = 0; Index < Wall.Count; ++Index)
	{
		FHostNode& Node = Scene.Nodes.emplace_back();
		Node.Mesh = 0;
		Node.Materials = {static_cast<int32_t>(Index)};
		Node.Translation = Wall.Origin + Wall.Step * glm::dvec3(Index % Wall.Columns, Index / Wall.Columns, 0);
	}
	return Scene;
}

FShaderSource MakeMaterialTrace(const FMaterialTraceDesc& Desc)
{
	FShaderSource Source;
	Source.Path = Desc.Path;
	Source.Text = TraceText;
	if (Desc.RaysPerMetre > 0.0) { Source.Defines.emplace_back("RAYS_PER_METRE", fmt::format("{:.1f}", Desc.RaysPerMetre)); }
	if (Desc.bCallables) { Source.Defines.emplace_back("CALLABLES", "1"); }
	return Source;
}

void AddMaterialTrace(FFrameContext& Context, uint32_t RayGen, FGraphTexture Target)
{
	const FFrameContext* const Frame = &Context;
	const FGraphTextureDesc Size = Context.Graph.GetDesc(Target);
	Context.Graph.AddPass("Trace", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Write(Target, ERTAccess::StorageWrite);
		return [=](FPassContext& Pass) {
			const FTracePush Push{Frame->Pass, Pass.GetTexture(Target)->GetStorageIndex()};
			Pass.Commands().SetPipeline(Frame->RayPipeline->GetPipeline());
			Pass.Commands().PushConstants(&Push, sizeof(Push));
			Pass.Commands().TraceRays(Frame->RayTable->GetTable(), RayGen, Size.Width, Size.Height, 1);
		};
	});
}

void AddMaterialTraceReadback(FFrameContext& Context, uint32_t RayGen, uint32_t Width, uint32_t Height, IRTBuffer* Readback)
{
	FFrameGraph& Graph = Context.Graph;
	const FGraphTexture Target = Graph.CreateTexture({Width, Height, ERTFormat::RGBA32_FLOAT}, "Trace");
	const FGraphBuffer Texels = Graph.ImportBuffer(Readback, ERTAccess::None, ERTAccess::HostRead, "Trace");
	AddMaterialTrace(Context, RayGen, Target);
	Graph.AddPass("ReadTrace", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(Target, ERTAccess::CopyRead);
		Builder.Write(Texels, ERTAccess::CopyWrite);
		return [=](FPassContext& Pass) { Pass.Commands().CopyTextureToBuffer(Pass.GetBuffer(Texels), 0, Pass.GetTexture(Target), 0, 0); };
	});
}

} // namespace Lantern
