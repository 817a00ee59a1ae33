// The scene's own passes: tables, acceleration structures, shader records.
#include <algorithm>
#include <utility>

#include "LanternCore/Tasks/Tasks.h"
#include "LanternRenderer/Renderer.h"

namespace Lantern
{

void FSceneTokens::WriteAlone(FPassBuilder& Builder, FGraphToken Written) const
{
	for (const FGraphToken Token : {Tables, Vertices, Structures, Records, Sky})
	{
		if (Token.Index == Written.Index) { Builder.Write(Token); }
		else { Builder.Without(Token); }
	}
}

void FRenderer::AddTables()
{
	if (!bUpdating || !Context->Scene.NeedsTables()) { return; }
	FFrameContext* const Frame = Context.get();
	Graph->AddPass("SceneUpdate", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.NeverCull();
		Builder.RecordOnTask();
		Builder.AllowAsync();
		Frame->Tokens.WriteAlone(Builder, Frame->Tokens.Tables);
		return [=, this](FPassContext& Pass) {
			if (FRTStatus S = Frame->Scene.RecordTables(Pass.Commands(), Uploads); !S) { Frame->Fail(S); }
		};
	});
}

namespace
{
void DeclareStructures(FPassBuilder& Builder, const FSceneTokens& Tokens)
{
	Builder.AllowAsync();
	Builder.Write(Tokens.Structures);
	for (const FGraphToken Unused : {Tokens.Tables, Tokens.Records, Tokens.Sky}) { Builder.Without(Unused); }
}
} // namespace

/// Many refits are recorded by several tasks.
void FRenderer::AddBuildPasses()
{
	constexpr size_t MostParts = 8;
	FFrameContext* const Frame = Context.get();
	const uint32_t Parts = Frame->Scene.PlanBuilds(static_cast<uint32_t>(std::min(GetWorkerCount(), MostParts)));
	for (uint32_t Part = 0; Part < Parts; ++Part)
	{
		Graph->AddPass("Builds", [&](FPassBuilder& Builder) -> FPassExecute {
			Builder.NeverCull();
			Builder.RecordOnTask();
			DeclareStructures(Builder, Frame->Tokens);
			return [=](FPassContext& Pass) { Frame->Scene.RecordBuilds(Pass.Commands(), Part); };
		});
	}
}

void FRenderer::AddRayPasses()
{
	if (std::exchange(bRayPassesAdded, true)) { return; }
	FFrameContext* const Frame = Context.get();
	if (bUpdating && Frame->Scene.NeedsStructures())
	{
		AddBuildPasses();
		Graph->AddPass("Structures", [&](FPassBuilder& Builder) -> FPassExecute {
			Builder.NeverCull();
			DeclareStructures(Builder, Frame->Tokens);
			return [=, this](FPassContext& Pass) {
				if (FRTStatus S = Frame->Scene.RecordStructures(Pass.Commands(), Uploads); !S) { Frame->Fail(S); }
			};
		});
	}
	if (Frame->RayPipeline)
	{
		Graph->AddPass("ShaderTable", [&](FPassBuilder& Builder) -> FPassExecute {
			Builder.NeverCull();
			Builder.AllowAsync();
			Frame->Tokens.WriteAlone(Builder, Frame->Tokens.Records);
			return [=, this](FPassContext& Pass) {
				FRTStatus Status = FinishPrebind();
				if (Status) { Status = ShaderTable.Record(Pass.Commands()); }
				if (!Status) { Frame->Fail(Status); }
			};
		});
	}
}

void FFrameContext::RequireRays() const { Owner->AddRayPasses(); }

} // namespace Lantern
