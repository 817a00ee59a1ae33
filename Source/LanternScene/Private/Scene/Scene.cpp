// FRTScene: the front of a scene's parts, and the block of constants that is put together from them.
#include "LanternScene/Scene/Scene.h"

#include <utility>

#include "LanternCore/Config/ConsoleVariables.h"
#include "Scene/SceneUpdate.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<int32_t> CVarArrivals("r.RT.Scene.ArrivalsPerFrame", 250,
    "Limits how many materials, meshes and objects of an engine a frame adds to the scene or removes from it. A new mesh counts as "
    "four. The rest waits for the next frames. 0: no limit.",
    {0, 1'000'000});
} // namespace

uint32_t FRTScene::GetMostArrivals() { return static_cast<uint32_t>(CVarArrivals.GetOnRenderThread()); }

FRTScene::FRTScene(IRTDevice& Device)
    : Geometries(Device),
      Frame(std::make_unique<FSceneUpdate>(FSceneParts{Device, Geometries, Materials, Objects, Lights, Emissive}))
{}
FRTScene::~FRTScene() = default;

void FRTScene::MarkFilled(const FRTGeometryRef& Geometry)
{
	Geometries.MarkFilled(Geometry);
	// Light sampling lists no triangle whose vertices are missing.
	if (Emissive.HasObjects()) { Emissive.MarkLists(); }
}

void FRTScene::MarkDeformed(const FRTGeometryRef& Geometry)
{
	Geometries.MarkDeformed(Geometry);
	Objects.MarkDeformed(Geometry);
}

void FRTScene::SetMaterial(uint32_t Index, const FMaterialData& Material)
{
	const FMaterialData& Old = Materials.GetTable()[Index];
	if (FSectionTable::AffectsShape(Old, Material)) { Objects.GetCasterChanges().AddAnywhere(); }
	const FAppearanceChange Change = CompareAppearance(Old, Material);
	if (Change.Part > 0.0) { Objects.NoteAppearance(Index, Change); }
	Materials.Set(Index, Material);
}

void FRTScene::SetMaterialProgram(uint32_t Index, uint32_t Program)
{
	if (Materials.GetProgram(Index) != Program) { Objects.GetCasterChanges().AddAnywhere(); }
	Materials.SetProgram(Index, Program);
}

void FRTScene::SetMaterialOverride(uint32_t Override)
{
	if (Materials.GetContext().Override != Override) { Objects.GetCasterChanges().AddAnywhere(); }
	Materials.SetOverride(Override);
}

void FRTScene::SetAlphaTest(bool bEnabled)
{
	if (Materials.GetContext().bAlphaTest != bEnabled) { Objects.GetCasterChanges().AddAnywhere(); }
	Materials.SetAlphaTest(bEnabled);
}

void FRTScene::SetTransmission(bool bEnabled)
{
	if (Materials.GetContext().bTransmission != bEnabled) { Objects.GetCasterChanges().AddAnywhere(); }
	Materials.SetTransmission(bEnabled);
}

FLightId FRTScene::AddLight(const FSceneLight& Light)
{
	const FLightId Id = Lights.GetStore().Add(Light);
	Frame->RefreshLightFacts();
	return Id;
}

void FRTScene::SetLight(FLightId Id, const FSceneLight& Light)
{
	Lights.GetStore().Set(Id, Light);
	Frame->RefreshLightFacts();
}

void FRTScene::RemoveLight(FLightId Id)
{
	Lights.GetStore().Remove(Id);
	Frame->RefreshLightFacts();
}

void FRTScene::SetCastingLights(uint32_t Kinds)
{
	Lights.GetStore().SetCastingKinds(Kinds);
	Frame->RefreshLightFacts();
}

void FRTScene::SetSun(const FSunLight& Sun)
{
	Lights.SetSun(Sun);
	Frame->RefreshLightFacts();
}

void FRTScene::SetSky(glm::vec3 Radiance)
{
	Lights.SetSky(Radiance);
	Frame->RefreshLightFacts();
}

void FRTScene::SetSkyMap(const FSkyMap& Map)
{
	Lights.SetSkyMap(Map);
	Frame->RefreshLightFacts();
}

void FRTScene::SetSkyProgram(const std::optional<FSkyProgram>& Program)
{
	Lights.SetSkyProgram(Program);
	Frame->RefreshLightFacts();
}

void FRTScene::SetMissingPrograms(std::vector<FHitProgram> Programs) { Frame->GetBindings().SetMissingPrograms(std::move(Programs)); }
void FRTScene::SetRayTypes(uint32_t Count) { Frame->GetBindings().SetRayTypes(Count); }
const FSceneFacts& FRTScene::RefreshFacts() { return Frame->RefreshFacts(); }
const FSceneFacts& FRTScene::GetFacts() const { return Frame->GetFacts(); }
bool FRTScene::NeedsUpdate(const FGatherView& View, const FSceneUse& Use) const { return Frame->NeedsUpdate(View, Use); }
glm::dvec3 FRTScene::GetOrigin() const { return Frame->GetOrigin(); }

FRTStatus FRTScene::BeginUpdate(const FGatherView& View, const FSceneUse& Use) { return Frame->Begin(View, Use); }
uint32_t FRTScene::PlanBuilds(uint32_t MostParts) { return Geometries.Plan(MostParts); }
void FRTScene::RecordBuilds(IRTCommandList& List, uint32_t Part) const { Geometries.RecordPart(List, Part); }
bool FRTScene::NeedsTables() const { return Frame->AreTablesDirty(); }
bool FRTScene::NeedsStructures() const { return Frame->NeedsStructures(); }
FRTStatus FRTScene::RecordTables(IRTCommandList& List, FFrameUploads& Uploads) { return Frame->RecordTables(List, Uploads); }
FRTStatus FRTScene::RecordStructures(IRTCommandList& List, FFrameUploads&) { return Frame->RecordStructures(List); }

FRTStatus FRTScene::RecordUpdate(IRTCommandList& List, FFrameUploads& Uploads)
{
	const FRTStatus Status = RecordTables(List, Uploads);
	return Status ? RecordStructures(List, Uploads) : Status;
}

FRTStatus FRTScene::Update(IRTCommandList& List, FFrameUploads& Uploads, const FGatherView& View, const FSceneUse& Use)
{
	if (FRTStatus S = BeginUpdate(View, Use); !S) { return S; }
	return RecordUpdate(List, Uploads);
}

void FRTScene::EndFrame(bool bSubmitted, FRTFence Fence) { Frame->EndFrame(bSubmitted, Fence); }

IRTScene* FRTScene::GetStructure() const { return Frame->GetStructure().Get(); }
uint32_t FRTScene::GetInstanceCount() const { return Frame->GetStructure().GetInstanceCount(); }
const FSceneUpdateStats& FRTScene::GetStats() const { return Frame->GetStats(); }

FSceneConstants FRTScene::GetConstants() const
{
	FSceneConstants C{};
	C.Objects = Objects.GetTable().GetAddress();
	C.ObjectChannels = Objects.GetChannels().Num() > 0 ? Objects.GetChannels().GetAddress() : 0;
	Objects.GetToons().FillConstants(C);
	C.Sections = Materials.GetSections().GetTable().GetAddress();
	C.Materials = Materials.GetTable().GetAddress();
	Lights.FillConstants(C);
	Emissive.FillConstants(C);
	C.Tlas = GetStructure() ? GetStructure()->GetIndex() : ~0u;
	C.MaterialOverride = Materials.GetContext().Override;
	C.OriginCell = FindCell(GetOrigin());
	C.OriginInCell = glm::vec3(GetOrigin() - CellCenter(C.OriginCell));
	C.ObjectReach = Objects.GetPivots().GetReach();
	C.ObjectMotions = GetMotions().GetTable().Num() > 0 ? GetMotions().GetTable().GetAddress() : 0;
	return C;
}

} // namespace Lantern
