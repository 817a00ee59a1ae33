// Contact shadows: when they are wanted, and what their shader has to know.
#include "Tiles/Contact.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<int32_t> CVarContact("r.RT.Shadow.Contact", 1,
    "Sun shadows of 0.3 m by depth, of what casts no rays. 0: off. 1: of objects that r.RT.Culling.Shadow.MinPixels leaves out. 2: of "
    "pixels whose motion vectors name no object, too, for foliage that the scene does not have.",
    {0, 2});

/// Motion vectors that name objects; invalid: none do.
FGraphTexture FindNames(const FGBuffer& GBuffer)
{
	return GBuffer.bNamesObjects && !MakeContactDefines().empty() ? GBuffer.Motion : FGraphTexture();
}
} // namespace

FShaderDefines MakeContactDefines()
{
	const FCullingSettings Culling = FCullingSettings::FromConsole();
	const bool bCulled = Culling.bEnabled && Culling.ShadowMinPixels > 0.0f;
	const bool bWanted = CVarContact.GetOnRenderThread() > (bCulled ? 0 : 1);
	return bWanted ? FShaderDefines{{"CONTACT", "1"}} : FShaderDefines{};
}

void DeclareContact(FPassBuilder& Builder, const FGBuffer& GBuffer)
{
	if (const FGraphTexture Names = FindNames(GBuffer); Names.IsValid()) { Builder.Read(Names, ERTAccess::ShaderRead); }
}

FContactConstants MakeContactConstants(FPassContext& Pass, const FFrameContext& Context, const FGBuffer& GBuffer)
{
	constexpr float Everywhere = 1e30f;
	const FCullingRule Rule(MakeGatherView(Context.View), FCullingSettings::FromConsole());
	FContactConstants C{};
	C.Motion = GetSampledIndex(Pass, FindNames(GBuffer));
	C.bUnnumbered = CVarContact.GetOnRenderThread() == 2 ? 1u : 0u;
	C.ObjectCount = Context.Scene.GetObjectSlotCount();
	C.DistanceOfRadius = Rule.bCull && Rule.bShadowLimit ? static_cast<float>(Rule.ShadowScale) : Everywhere;
	return C;
}

} // namespace Lantern
