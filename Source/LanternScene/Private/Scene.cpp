#include "LanternScene/Scene.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include <glm/gtc/packing.hpp>

#include "GeometryBuilder.h"
#include "LanternCore/ConsoleVariables.h"
#include "LanternScene/SectionTable.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<int32_t> CVarRebuildInterval("r.RT.Skinning.RebuildInterval", 16,
                                                "Deformed geometry is refitted, and rebuilt every so many frames. 1: always rebuilt.", {1, 1000});
} // namespace

FRTScene::FRTScene(IRTDevice& InDevice) : Device(InDevice) {}
FRTScene::~FRTScene() = default;

FRTStatus FRTScene::CreateGeometry(FRTGeometryInfo Info, FRTGeometryRef& Out)
{
	assert(!Info.Sections.empty());
	auto Geometry = std::make_shared<FRTGeometry>(std::move(Info));
	const uint64_t Triangles = Geometry->GetPrimitiveCount();
	if (const uint64_t Most = Device.GetCapabilities().MaxPrimitiveCount; Triangles > Most)
	{
		return FRTStatus::Error(ERTResult::Unsupported, "%s has %llu triangles; the device allows %llu", Geometry->Info.Name.c_str(),
		                        static_cast<unsigned long long>(Triangles), static_cast<unsigned long long>(Most));
	}
	PendingBuilds.push_back(Geometry);
	if (Geometry->Info.bDynamic) { bFactsChanged = true; }
	Geometries.push_back(Geometry);
	Out = std::move(Geometry);
	return FRTStatus::Success();
}

void FRTScene::MarkDeformed(const FRTGeometryRef& Geometry)
{
	assert(Geometry->Info.bDynamic);
	if (!Geometry->bBuilt || Geometry->bDeformed) { return; }
	Geometry->bDeformed = true;
	Deformed.push_back(Geometry);
}

uint32_t FRTScene::AddMaterial(const FMaterialData& Material) { return Materials.Add(Material); }

void FRTScene::SetMaterial(uint32_t Index, const FMaterialData& Material)
{
	assert(Index < Materials.Num());
	const FMaterialData Old = Materials[Index];
	// An animated colour or roughness rebuilds nothing.
	bObjectsChanged |= Old.Flags != Material.Flags;
	bEmissiveChanged |= Old.EmissiveWeight != Material.EmissiveWeight;
	bFactsChanged = true;
	Materials.Set(Index, Material);
	if (FSectionTable::AffectsSections(Old, Material)) { Sections.MaterialChanged(Index); }
}

FRTObjectId FRTScene::AddObject(FRTObjectInfo Info)
{
	assert(Info.Geometry && Info.Materials.size() == Info.Geometry->GetSectionCount());
	uint32_t Index = static_cast<uint32_t>(Objects.size());
	if (FreeObjects.empty()) { Objects.emplace_back(); }
	else
	{
		Index = FreeObjects.back();
		FreeObjects.pop_back();
	}
	assert(Index <= MaxInstanceIndex);
	FObject& Object = Objects[Index];
	Object.Info = std::move(Info);
	Object.bAlive = true;
	Object.Range = Sections.Acquire(*Object.Info.Geometry, Object.Info.Materials);
	WriteObject(Index);
	bObjectsChanged = bFactsChanged = bEmissiveChanged = true;
	return {Index, Object.Generation};
}

void FRTScene::RemoveObject(FRTObjectId Id)
{
	FObject& Object = Resolve(Id);
	Sections.Release(Object.Range);
	Retired.push_back(std::move(Object.Info.Geometry));
	Object.Info = {};
	Object.bAlive = false;
	++Object.Generation;
	FreeObjects.push_back(Id.Index);
	bObjectsChanged = bFactsChanged = bEmissiveChanged = true;
}

FRTScene::FObject& FRTScene::Resolve(FRTObjectId Id)
{
	assert(Id.Index < Objects.size() && Objects[Id.Index].bAlive && Objects[Id.Index].Generation == Id.Generation);
	return Objects[Id.Index];
}

const FRTScene::FObject& FRTScene::Resolve(FRTObjectId Id) const { return const_cast<FRTScene*>(this)->Resolve(Id); }

void FRTScene::SetTransform(FRTObjectId Id, const glm::dmat4& Transform)
{
	Resolve(Id).Info.Transform = Transform;
	WriteObject(Id.Index);
	bObjectsChanged = true;
	bEmissiveChanged |= Facts.bEmissive;
}

void FRTScene::SetMaterials(FRTObjectId Id, std::vector<uint32_t> SectionMaterials)
{
	FObject& Object = Resolve(Id);
	const FSectionRangeId Range = Sections.Acquire(*Object.Info.Geometry, SectionMaterials);
	Sections.Release(std::exchange(Object.Range, Range));
	Object.Info.Materials = std::move(SectionMaterials);
	WriteObject(Id.Index);
	bObjectsChanged = bFactsChanged = bEmissiveChanged = true;
}

const FRTObjectInfo& FRTScene::GetObject(FRTObjectId Id) const { return Resolve(Id).Info; }
uint32_t FRTScene::GetFirstSection(FRTObjectId Id) const { return FirstSectionOf(Resolve(Id)); }

void FRTScene::WriteObject(uint32_t Index)
{
	const FObject& Object = Objects[Index];
	glm::dmat4 Relative = Object.Info.Transform;
	Relative[3] -= glm::dvec4(Origin, 0.0);
	FObjectData Data{};
	for (int Row = 0; Row < 3; ++Row)
	{
		Data.ObjectToWorld[Row] = glm::vec4(Relative[0][Row], Relative[1][Row], Relative[2][Row], Relative[3][Row]);
	}
	Data.FirstSection = FirstSectionOf(Object);
	Data.Flags = glm::determinant(glm::dmat3(Relative)) < 0.0 ? OBJECT_MIRRORED : 0u;
	ObjectData.Set(Index, Data);
}

void FRTScene::SetMaterialOverride(uint32_t Override)
{
	if (std::exchange(SectionContext.Override, Override) == Override) { return; }
	bFactsChanged = bObjectsChanged = true;
	Sections.RefillAll();
}

void FRTScene::SetAlphaTest(bool bEnabled)
{
	if (std::exchange(SectionContext.bAlphaTest, bEnabled) == bEnabled) { return; }
	bFactsChanged = bObjectsChanged = true;
	Sections.RefillAll();
}

void FRTScene::SetRayTypes(uint32_t Count)
{
	bObjectsChanged |= RayTypes != Count;
	RayTypes = Count;
}

void FRTScene::UpdateFacts()
{
	Facts = {};
	for (const FObject& Object : Objects)
	{
		if (!Object.bAlive) { continue; }
		++Facts.Objects;
	}
	Facts.bMasked = Sections.GetMaskedRangeCount() > 0;
	Facts.bEmissive = Sections.GetEmissiveRangeCount() > 0;
	std::erase_if(Geometries, [](const std::weak_ptr<FRTGeometry>& Geometry) { return Geometry.expired(); });
	for (const auto& Weak : Geometries)
	{
		const FRTGeometryRef Geometry = Weak.lock();
		Facts.DynamicGeometries += Geometry && Geometry->Info.bDynamic ? 1 : 0;
	}
	Facts.Lights = static_cast<uint32_t>(Lights.size());
	Facts.EmissiveTriangles = EmissiveTriangles.Num();
	Facts.bSun = Sun.Irradiance > 0.0f;
	Facts.bSky = glm::any(glm::greaterThan(Sky, glm::vec3(0)));
	bFactsChanged = false;
}

const FSceneFacts& FRTScene::RefreshFacts()
{
	if (bFactsChanged) { UpdateFacts(); }
	return Facts;
}

bool FRTScene::AreTablesDirty() const
{
	return Materials.IsDirty() || ObjectData.IsDirty() || LightData.IsDirty() || EmissiveTriangles.IsDirty() || Sections.GetTable().IsDirty();
}

bool FRTScene::NeedsUpdate(const FGatherView& View, const FSceneUse& Use) const
{
	const bool bStructures = bObjectsChanged || !Structure || !PendingBuilds.empty() || !Deformed.empty();
	return bFactsChanged || bLightsChanged || (Use.bRays && bStructures) || (Use.bLightSampling && bEmissiveChanged) || AreTablesDirty() ||
	       SnapOrigin(View.Position) != Origin;
}

glm::dvec3 FRTScene::SnapOrigin(glm::dvec3 Camera) const
{
	// A camera that goes to and fro across a border of the grid must not rewrite the scene each time.
	const glm::dvec3 Away = glm::abs(Camera - Origin);
	if (std::max({Away.x, Away.y, Away.z}) <= 0.75 * OriginStep) { return Origin; }
	return glm::floor(Camera / OriginStep + 0.5) * OriginStep;
}

void FRTScene::MoveOrigin(glm::dvec3 Camera)
{
	const glm::dvec3 Snapped = SnapOrigin(Camera);
	if (Snapped == Origin) { return; }
	Origin = Snapped;
	for (uint32_t Index = 0; Index < Objects.size(); ++Index)
	{
		if (Objects[Index].bAlive) { WriteObject(Index); }
	}
	bObjectsChanged = bLightsChanged = bEmissiveChanged = true;
}

FRTStatus FRTScene::BuildPending(IRTCommandList& List)
{
	std::vector<FRTGeometryRef> Work = std::move(PendingBuilds);
	PendingBuilds.clear();
	for (const FRTGeometryRef& Geometry : Deformed)
	{
		Geometry->bDeformed = false;
		Work.push_back(Geometry);
	}
	Deformed.clear();
	if (Work.empty()) { return FRTStatus::Success(); }
	RecordedBuilds.insert(RecordedBuilds.end(), Work.begin(), Work.end());
	bObjectsChanged = true;
	const FRTBarrier Structures{nullptr, nullptr, ERTAccess::TraceRead | ERTAccess::BuildWrite, ERTAccess::BuildWrite};
	List.Barriers(&Structures, 1);
	return FGeometryBuilder(Device, Scratch).Build(List, Work, static_cast<uint32_t>(CVarRebuildInterval.GetOnRenderThread()), Stats);
}

FRTStatus FRTScene::ReserveStructure(uint32_t InstanceCount)
{
	if (Structure && Structure->GetMaxInstances() >= InstanceCount) { return FRTStatus::Success(); }
	const uint64_t Most = std::min<uint64_t>(Device.GetCapabilities().MaxInstanceCount, MaxInstanceIndex);
	if (InstanceCount > Most)
	{
		return FRTStatus::Error(ERTResult::Unsupported, "the scene has %u objects; the device allows %llu", InstanceCount, static_cast<unsigned long long>(Most));
	}
	const uint32_t Capacity = static_cast<uint32_t>(std::min<uint64_t>(Most, std::max({64u, InstanceCount, Structure ? 2 * Structure->GetMaxInstances() : 0u})));
	FRTSceneDesc Desc;
	Desc.MaxInstances = Capacity;
	Desc.Name = "Scene";
	return Device.CreateScene(Desc, Structure.ReleaseAndGetAddress());
}

FRTStatus FRTScene::BuildStructure(IRTCommandList& List, FFrameUploads& Uploads)
{
	if (FRTStatus S = ReserveStructure(Facts.Objects); !S) { return S; }
	// An instance names its first hit record with 24 bits.
	if (uint64_t(Sections.GetCapacity()) * RayTypes > MaxInstanceIndex)
	{
		return FRTStatus::Error(ERTResult::Unsupported, "the scene has %u sections; %u ray types allow %u", Sections.GetCapacity(), RayTypes, MaxInstanceIndex / RayTypes);
	}
	FUploadSlice Slice;
	if (FRTStatus S = Uploads.Allocate(std::max<uint64_t>(1, Facts.Objects) * sizeof(FRTInstance), Slice); !S) { return S; }
	auto* Instance = static_cast<FRTInstance*>(Slice.Data);
	uint32_t Count = 0;
	for (uint32_t Index = 0; Index < Objects.size(); ++Index)
	{
		const FObject& Object = Objects[Index];
		if (!Object.bAlive) { continue; }
		static_assert(sizeof(Instance->Transform) == sizeof(FObjectData::ObjectToWorld));
		FRTInstance Value;
		std::memcpy(Value.Transform, ObjectData[Index].ObjectToWorld, sizeof(Value.Transform));
		// Facing can be switched off for instances, not for sections: mixed objects are culled.
		const FSectionRange& Range = Sections.GetRange(Object.Range);
		const uint8_t Flags = (Range.bMasked ? 0 : InstanceForceOpaque) | (Range.bDoubleSided ? InstanceCullDisable : 0);
		Value.CustomIndexAndMask = Index | (uint32_t(Object.Info.Mask) << 24);
		Value.TableOffsetAndFlags = (Range.First * RayTypes) | (uint32_t(Flags) << 24);
		Value.GeometryAddress = Object.Info.Geometry->Structure->GetDeviceAddress();
		Instance[Count++] = Value;
	}
	Stats.InstancesWritten = Count;
	FGeometryBuilder Builder(Device, Scratch);
	if (FRTStatus S = Builder.ReserveScratch(std::max<uint64_t>(1, Structure->GetBuildSizes().BuildScratchBytes)); !S) { return S; }
	const FRTBarrier Before{nullptr, nullptr, ERTAccess::TraceRead | ERTAccess::BuildWrite, ERTAccess::BuildWrite | ERTAccess::BuildRead};
	List.Barriers(&Before, 1);
	List.BuildScene(Structure.Get(), Slice.Buffer, Slice.Offset, Count, Scratch.Get(), 0);
	const FRTBarrier After{nullptr, nullptr, ERTAccess::BuildWrite, ERTAccess::TraceRead};
	List.Barriers(&After, 1);
	bObjectsChanged = false;
	return FRTStatus::Success();
}

FRTStatus FRTScene::FlushTables(IRTCommandList& List, FFrameUploads& Uploads)
{
	if (!AreTablesDirty()) { return FRTStatus::Success(); }
	const FRTBarrier Before{nullptr, nullptr, UploadedAccess, ERTAccess::CopyWrite};
	List.Barriers(&Before, 1);
	for (FRTStatus S : {Materials.Flush(Device, List, Uploads), ObjectData.Flush(Device, List, Uploads), LightData.Flush(Device, List, Uploads),
	                    EmissiveTriangles.Flush(Device, List, Uploads), Sections.GetTable().Flush(Device, List, Uploads)})
	{
		if (!S) { return S; }
	}
	Stats.BytesCopied = Materials.GetCopiedBytes() + ObjectData.GetCopiedBytes() + LightData.GetCopiedBytes() +
	                    EmissiveTriangles.GetCopiedBytes() + Sections.GetTable().GetCopiedBytes();
	const FRTBarrier After{nullptr, nullptr, ERTAccess::CopyWrite, UploadedAccess};
	List.Barriers(&After, 1);
	return FRTStatus::Success();
}

FRTStatus FRTScene::BeginUpdate(const FGatherView& View, const FSceneUse& Use)
{
	Stats = {};
	FrameUse = Use;
	MoveOrigin(View.Position);
	RefreshFacts();
	if (bLightsChanged) { UpdateLights(); }
	if (FrameUse.bLightSampling && bEmissiveChanged) { UpdateEmissiveTriangles(); }
	return FRTStatus::Success();
}

FRTStatus FRTScene::RecordUpdate(IRTCommandList& List, FFrameUploads& Uploads)
{
	const FRTStatus Status = RecordTables(List, Uploads);
	return Status ? RecordStructures(List, Uploads) : Status;
}

FRTStatus FRTScene::RecordTables(IRTCommandList& List, FFrameUploads& Uploads) { return FlushTables(List, Uploads); }

FRTStatus FRTScene::RecordStructures(IRTCommandList& List, FFrameUploads& Uploads)
{
	if (!FrameUse.bRays) { return FRTStatus::Success(); }
	if (FRTStatus S = BuildPending(List); !S) { return S; }
	if (bObjectsChanged || !Structure) { return BuildStructure(List, Uploads); }
	return FRTStatus::Success();
}

FRTStatus FRTScene::Update(IRTCommandList& List, FFrameUploads& Uploads, const FGatherView& View, const FSceneUse& Use)
{
	if (FRTStatus S = BeginUpdate(View, Use); !S) { return S; }
	return RecordUpdate(List, Uploads);
}

void FRTScene::Rerecord()
{
	Materials.Invalidate();
	ObjectData.Invalidate();
	LightData.Invalidate();
	EmissiveTriangles.Invalidate();
	Sections.GetTable().Invalidate();
	for (FRTGeometryRef& Geometry : RecordedBuilds)
	{
		Geometry->bBuilt = false; // a refit may have been lost: only a build is right whatever happened before
		PendingBuilds.push_back(std::move(Geometry));
	}
	RecordedBuilds.clear();
	bObjectsChanged = true;
}

void FRTScene::EndFrame(bool bSubmitted, FRTFence)
{
	if (!bSubmitted) { return Rerecord(); }
	RecordedBuilds.clear();
	RetiredBefore = std::move(Retired);
	Retired.clear();
}

} // namespace Lantern
