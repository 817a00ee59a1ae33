// The passes before and behind diffuse global illumination that give objects a stylised look.
#include "Toon/Toon.h"

#include "ToonTypes.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarToon(
    "r.RT.GI.Toon", true, "Diffuse indirect light falls on objects with a toon style as the style says. If off, as on any other.");
TRTConsoleVariable<bool> CVarKnee(
    "r.RT.Debug.GI.ToonKnee", true, "Planted fault. If off, limits of toon styles cut light off with a kink.");

FShaderSource MakeGradeSource(bool bReference)
{
	FShaderDefines Defines;
	if (bReference) { Defines.emplace_back("REFERENCE", "1"); }
	if (!bReference && !CVarKnee.GetOnRenderThread()) { Defines.emplace_back("NO_TOON_KNEE", "1"); }
	return MakeComputeSource("Toon/ToonGrade.comp", std::move(Defines));
}

FToonGradeConstants MakeGradeConstants(FPassContext& Pass, const FFrameContext& Frame, const FGBuffer& GBuffer)
{
	FToonGradeConstants C{};
	C.Pass = Frame.Pass;
	C.Depth = GetSampledIndex(Pass, GBuffer.Depth);
	C.Normals = GetSampledIndex(Pass, Frame.Toon.Normals);
	C.Pixels = GetSampledIndex(Pass, Frame.Toon.Pixels);
	return C;
}

void DeclareGrade(FPassBuilder& Builder, const FFrameContext& Context, const FGBuffer& GBuffer)
{
	for (const FGraphTexture Texture : {GBuffer.Depth, Context.Toon.Normals, Context.Toon.Pixels})
	{
		Builder.Read(Texture, ERTAccess::ShaderRead);
	}
}
} // namespace

FShaderSource MakeToonSurfaceSource() { return MakeComputeSource("Toon/ToonSurface.comp"); }

bool AreToonStylesOn() { return CVarToon.GetOnRenderThread(); }

void ListToonShaders(const FSceneFacts& Facts, bool bReference, std::vector<FShaderSource>& Out)
{
	if (!Facts.bToon || !AreToonStylesOn()) { return; }
	Out.push_back(MakeToonSurfaceSource());
	Out.push_back(MakeGradeSource(bReference));
}

FGBuffer RequireToonSurface(FFrameContext& Context, const FGBuffer& GBuffer)
{
	FGBuffer Styled = GBuffer;
	if (Context.Toon.IsValid())
	{
		Styled.Normals = Context.Toon.Normals;
		return Styled;
	}
	const FGraphTexture Numbers = GBuffer.ToonNumbers;
	const FGraphTexture Motion = !Numbers.IsValid() && GBuffer.bNamesObjects ? GBuffer.Motion : FGraphTexture();
	if (!Context.Facts.bToon || !AreToonStylesOn() || (!Numbers.IsValid() && !Motion.IsValid())) { return GBuffer; }
	IRTPipeline* const Pipeline = RequireCompute(Context, MakeToonSurfaceSource());
	if (!Pipeline) { return GBuffer; }
	const FFrameContext* const Frame = &Context;
	FToonOfFrame& Toon = Context.Toon;
	Toon.Normals = Context.Graph.CreateTexture({Context.Width, Context.Height, ERTFormat::RGBA16_SNORM}, "ToonNormals");
	Toon.Pixels = Context.Graph.CreateTexture({Context.Width, Context.Height, ERTFormat::RG32_FLOAT}, "ToonPixels");
	Context.Graph.AddPass("ToonSurface", [&](FPassBuilder& Builder) -> FPassExecute {
		for (const FGraphTexture Texture : {GBuffer.Depth, GBuffer.Normals, Numbers.IsValid() ? Numbers : Motion})
		{
			Builder.Read(Texture, ERTAccess::ShaderRead);
		}
		for (const FGraphTexture Texture : {Toon.Normals, Toon.Pixels}) { Builder.Write(Texture, ERTAccess::StorageWrite); }
		Builder.AllowAsync();
		return [=, Source = GBuffer, Out = Toon](FPassContext& Pass) {
			FToonSurfaceConstants C{};
			C.Pass = Frame->Pass;
			C.Depth = GetSampledIndex(Pass, Source.Depth);
			C.Normals = GetSampledIndex(Pass, Source.Normals);
			C.Numbers = GetSampledIndex(Pass, Numbers);
			C.NumbersOffset = Source.ClassesOffset.x | (Source.ClassesOffset.y << 16);
			C.Motion = GetSampledIndex(Pass, Motion);
			C.OutNormals = GetStorageIndex(Pass, Out.Normals);
			C.OutPixels = GetStorageIndex(Pass, Out.Pixels);
			Dispatch2D(Pass, Pipeline, C, Frame->Width, Frame->Height, TOON_GROUP_SIZE);
		};
	});
	Styled.Normals = Toon.Normals;
	return Styled;
}

FGraphTexture AddToonGrade(FFrameContext& Context, const FGBuffer& GBuffer, FGraphTexture Signal, bool bHorizon, bool bFiltered)
{
	if (!Context.Toon.IsValid() || !Signal.IsValid()) { return Signal; }
	IRTPipeline* const Pipeline = RequireCompute(Context, MakeGradeSource(false));
	if (!Pipeline) { return Signal; }
	const FFrameContext* const Frame = &Context;
	const FGraphTexture Output =
	    Context.Graph.CreateTexture({Context.Width, Context.Height, ERTFormat::RGBA16_FLOAT, ERTTextureUsage::CopySource}, "ToonLight");
	Context.Graph.AddPass("ToonGrade", [&](FPassBuilder& Builder) -> FPassExecute {
		DeclareGrade(Builder, Context, GBuffer);
		Builder.Read(Signal, ERTAccess::ShaderRead);
		Builder.Write(Output, ERTAccess::StorageWrite);
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			FToonGradeConstants C = MakeGradeConstants(Pass, *Frame, GBuffer);
			C.bHorizon = bHorizon ? 1u : 0u;
			C.bFiltered = bFiltered ? 1u : 0u;
			C.Signal = GetSampledIndex(Pass, Signal);
			C.Output = GetStorageIndex(Pass, Output);
			Dispatch2D(Pass, Pipeline, C, Frame->Width, Frame->Height, TOON_GROUP_SIZE);
		};
	});
	return Output;
}

void AddToonReferenceGrade(FFrameContext& Context, const FGBuffer& GBuffer, FGraphBuffer Sum)
{
	(void)RequireToonSurface(Context, GBuffer);
	IRTPipeline* const Pipeline = Context.Toon.IsValid() ? RequireCompute(Context, MakeGradeSource(true)) : nullptr;
	if (!Pipeline) { return; }
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass("ToonReferenceGrade", [&](FPassBuilder& Builder) -> FPassExecute {
		DeclareGrade(Builder, Context, GBuffer);
		Builder.Write(Sum, ERTAccess::StorageWrite | ERTAccess::ShaderRead);
		return [=](FPassContext& Pass) {
			FToonGradeConstants C = MakeGradeConstants(Pass, *Frame, GBuffer);
			C.bHorizon = 1u;
			C.Signal = C.Output = NO_TEXTURE;
			C.Sum = GetAddress(Pass, Sum);
			Dispatch2D(Pass, Pipeline, C, Frame->Width, Frame->Height, TOON_GROUP_SIZE);
		};
	});
}

} // namespace Lantern
