// The passes behind FEmissiveTriangles: clusters that changed, then the sums over all of them.
#include "Lights/EmissiveTriangles.h"

#include "EmissiveTypes.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarFloor("r.RT.Debug.Lights.EmissiveFloor", true,
    "Planted fault. Off: chances of emissive triangles go by their power alone, so that what is dim beside a floodlight has none.");

constexpr ERTAccess Written = ERTAccess::StorageWrite | ERTAccess::ShaderRead;

FShaderDefines MakeDefines(const FSceneFacts& Facts)
{
	FShaderDefines Defines;
	AddLightEmissionDefine(Facts, Defines);
	if (!CVarFloor.GetOnRenderThread()) { Defines.emplace_back("NO_FLOOR", "1"); }
	return Defines;
}

FShaderSource MakeTrianglesSource(const FSceneFacts& Facts)
{
	return MakeComputeSource("Lights/EmissiveTriangles.comp", MakeDefines(Facts));
}
FShaderSource MakePowersSource(const FSceneFacts& Facts) { return MakeComputeSource("Lights/EmissivePowers.comp", MakeDefines(Facts)); }
} // namespace

void ListEmissiveShaders(const FSceneFacts& Facts, std::vector<FShaderSource>& Out)
{
	if (!Facts.bEmissive) { return; }
	Out.push_back(MakeTrianglesSource(Facts));
	Out.push_back(MakePowersSource(Facts));
}

bool AreEmissiveShadersReady(const FFrameContext& Context)
{
	if (!Context.Facts.bEmissive) { return true; }
	return RequireCompute(Context, MakeTrianglesSource(Context.Facts)) && RequireCompute(Context, MakePowersSource(Context.Facts));
}

FRTStatus AddEmissivePass(FFrameContext& Context, FFrameUploads& Uploads)
{
	const FEmissiveWork Work = Context.Scene.GetEmissiveWork();
	if (Work.Count == 0) { return FRTStatus::Success(); }
	IRTPipeline* const Find = RequireCompute(Context, MakeTrianglesSource(Context.Facts));
	IRTPipeline* const Sum = RequireCompute(Context, MakePowersSource(Context.Facts));
	if (!Find || !Sum) { return *Context.Status; }
	FEmissiveConstants C{};
	C.Pass = Context.Pass;
	C.Count = Work.Count;
	if (!Work.Clusters->empty())
	{
		FUploadSlice Slice;
		if (FRTStatus S = Uploads.Push(Work.Clusters->data(), Work.Clusters->size() * sizeof(uint32_t), Slice); !S) { return S; }
		C.Clusters = Slice.Address;
	}
	Context.Graph.AddPass("EmissiveTriangles", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.NeverCull();
		Builder.RecordOnTask();
		Builder.AllowAsync();
		Builder.Write(Context.Tokens.Tables); // as part of which passes read them
		for (const FGraphToken Unused : {Context.Tokens.Structures, Context.Tokens.Records, Context.Tokens.Sky})
		{
			Builder.Without(Unused);
		}
		return [=, Triangles = Work.Triangles, Powers = Work.Powers, Bounds = Work.Bounds](FPassContext& Pass) {
			IRTCommandList& List = Pass.Commands();
			const FRTBarrier Before[] = {{Triangles, nullptr, ERTAccess::ShaderRead, Written},
			    {Powers, nullptr, ERTAccess::ShaderRead, Written}, {Bounds, nullptr, ERTAccess::ShaderRead, Written}};
			const FRTBarrier After[] = {{Triangles, nullptr, Written, ERTAccess::ShaderRead},
			    {Powers, nullptr, Written, ERTAccess::ShaderRead}, {Bounds, nullptr, Written, ERTAccess::ShaderRead}};
			const FRTBarrier Between{Powers, nullptr, Written, Written};
			List.Barriers(Before, 3);
			DispatchMany(Pass, Find, C, C.Count);
			List.Barriers(&Between, 1);
			List.SetPipeline(Sum);
			List.PushConstants(&C, sizeof(C));
			List.Dispatch(1, 1, 1);
			List.Barriers(After, 3);
		};
	});
	return FRTStatus::Success();
}

} // namespace Lantern
