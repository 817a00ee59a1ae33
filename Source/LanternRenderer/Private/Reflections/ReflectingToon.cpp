// Reflections of objects with a toon style.
#include "Reflections/ReflectingToon.h"

#include <algorithm>
#include <cmath>

#include "LanternCore/Config/ConsoleVariables.h"
#include "ReflectionTypes.h"
#include "Reflections/ReflectionPaths.h"
#include "TileTypes.h"
#include "Toon/Toon.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarToon("r.RT.Reflections.Toon", true,
    "Objects with a toon style reflect with their metal alone. The reflection's strength is the metalness at any angle, as far as a metal "
    "can: "
    "dark colours are brighter at grazing ones. It is to be added to what the host shows. If off, as any other object. Needs "
    "r.RT.GI.Toon.");
TRTConsoleVariable<float> CVarThreshold(
    "r.RT.Reflections.Toon.Threshold", 0.9f, "Metalness above which objects with a toon style reflect.", {0, 1});
TRTConsoleVariable<float> CVarMinRoughness(
    "r.RT.Reflections.Toon.MinRoughness", 0.1f, "Least roughness of reflections on objects with a toon style.", {0, 1});
TRTConsoleVariable<float> CVarMaxRoughness("r.RT.Reflections.Toon.MaxRoughness", 0.35f,
    "Greatest roughness of reflections on objects with a toon style. They never fade out: r.RT.Reflections.MaxRoughness limits it as well.",
    {0, 1});
TRTConsoleVariable<float> CVarTint("r.RT.Reflections.Toon.Tint", 1.0f,
    "Share of a metal's colour in its reflection, on objects with a toon style. 0: reflections have no colour of their own.", {0, 1});

FShaderSource MakeSource() { return MakeComputeSource("Reflections/Toon.comp"); }

bool AreOn(const FSceneFacts& Facts) { return Facts.bToon && AreToonStylesOn() && CVarToon.GetOnRenderThread(); }
} // namespace

void ListReflectingToonShaders(const FSceneFacts& Facts, std::vector<FShaderSource>& Out)
{
	if (!AreOn(Facts)) { return; }
	Out.push_back(MakeToonSurfaceSource());
	Out.push_back(MakeSource());
}

FGBuffer AddReflectingToon(FFrameContext& Context, const FGBuffer& GBuffer, float FullRoughness)
{
	const bool bSurface = GBuffer.BaseColor.IsValid() && GBuffer.Material.IsValid();
	IRTPipeline* const Pipeline = AreOn(Context.Facts) && bSurface ? RequireCompute(Context, MakeSource()) : nullptr;
	if (!Pipeline) { return GBuffer; }
	(void)RequireToonSurface(Context, GBuffer);
	const FToonOfFrame Toon = Context.Toon;
	if (!Toon.IsValid()) { return GBuffer; }
	FGBuffer Styled = GBuffer;
	// Eight linear bits would show steps in what is dark.
	Styled.BaseColor = Context.Graph.CreateTexture({Context.Width, Context.Height, ERTFormat::RGBA16_FLOAT}, "ReflectingColor");
	Styled.Material = Context.Graph.CreateTexture({Context.Width, Context.Height, ERTFormat::RGBA8_UNORM}, "ReflectingMaterial");
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass("ReflectionsToon", [&](FPassBuilder& Builder) -> FPassExecute {
		for (const FGraphTexture Texture : {GBuffer.Depth, GBuffer.Normals, GBuffer.BaseColor, GBuffer.Material, Toon.Pixels})
		{
			Builder.Read(Texture, ERTAccess::ShaderRead);
		}
		for (const FGraphTexture Texture : {Styled.BaseColor, Styled.Material}) { Builder.Write(Texture, ERTAccess::StorageWrite); }
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			FReflectionToonConstants C{};
			C.Pass = Frame->Pass;
			C.Pixels = GetReflectionPixels(Pass, GBuffer);
			C.ToonPixels = GetSampledIndex(Pass, Toon.Pixels);
			C.OutBaseColor = GetStorageIndex(Pass, Styled.BaseColor);
			C.OutMaterial = GetStorageIndex(Pass, Styled.Material);
			C.Threshold = CVarThreshold.GetOnRenderThread();
			C.Tint = CVarTint.GetOnRenderThread();
			// A G-buffer has eight bits, and rounding up would fade it out.
			C.MaxRoughness = std::floor(255.0f * std::min(CVarMaxRoughness.GetOnRenderThread(), FullRoughness)) / 255.0f;
			C.MinRoughness = std::min(CVarMinRoughness.GetOnRenderThread(), C.MaxRoughness);
			Dispatch2D(Pass, Pipeline, C, Frame->Width, Frame->Height, TILE_SIZE);
		};
	});
	return Styled;
}

} // namespace Lantern
