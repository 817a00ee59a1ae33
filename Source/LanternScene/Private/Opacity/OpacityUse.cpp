// Whether classified triangles may be used: the console variable, and the keys of materials.
#include "Opacity/OpacityUse.h"

#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternScene/Opacity/OpacityClassifier.h"
#include "ShaderTable/SectionData.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarClassify("r.RT.Opacity.Classify", true,
    "Skips the alpha test under rays for triangles that were found at load to be wholly opaque or transparent. Off: every triangle of "
    "alpha-tested geometry is tested. A change rebuilds that geometry.");

/// Without alpha tests, what they would cut away must be solid.
bool IsOpacityWanted(const FSectionContext& Context)
{
	return CVarClassify.GetOnRenderThread() && Context.bAlphaTest && Context.Override != 2;
}
} // namespace

bool HasClassifiedMaterials(const FSectionContext& Context, const FRTGeometry& Geometry, const std::vector<uint32_t>& Materials)
{
	if (!Geometry.HasClassifiedSections()) { return true; }
	for (uint32_t Section = 0; Section < Materials.size(); ++Section)
	{
		const FRTSectionInfo& Info = Geometry.GetInfo().Sections[Section];
		if (!Info.IsClassified()) { continue; }
		const uint32_t Material = Materials[Section];
		const uint32_t Program = Material < Context.Programs.size() ? Context.Programs[Material] : StandardProgram;
		// The list of emissive triangles counts whole triangles.
		const bool bEmissivePieces = Info.PieceCount > 0 && Context.Materials[Material].EmissiveWeight > 0.0f;
		if (IsTransmissive(Context, Context.Materials[Material])) { return false; } // light shines through all of it
		if (bEmissivePieces || MakeOpacityKey(Context.Materials[Material], Program) != Info.OpacityKey) { return false; }
	}
	return true;
}

bool NeedsOpacityUpdate(const FSectionContext& Context, const FSectionTable& Sections, const FGeometryStore& Store)
{
	return Sections.HasRefutedGeometries() || Store.IsOpacityUsed() != IsOpacityWanted(Context);
}

void UpdateOpacityUse(const FSectionContext& Context, FSectionTable& Sections, FGeometryStore& Store)
{
	for (const std::weak_ptr<const FRTGeometry>& Refuted : Sections.TakeRefutedGeometries())
	{
		if (const std::shared_ptr<const FRTGeometry> Geometry = Refuted.lock()) { Store.RefuteOpacity(Geometry->GetSlot()); }
	}
	Store.SetOpacityUse(IsOpacityWanted(Context));
}

} // namespace Lantern
