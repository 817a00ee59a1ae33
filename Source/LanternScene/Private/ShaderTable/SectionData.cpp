// FSectionData of a part: addresses, flags and hit class.
#include "ShaderTable/SectionData.h"

namespace Lantern
{

namespace
{
constexpr uint64_t AabbBytes = 6 * sizeof(float);

/// Fills in where the part's triangles lie and how their indices are read.
void AddTriangles(const FRTGeometry& Geometry, const FRTGeometryPart& Part, FSectionData& Data)
{
	const FRTGeometryInfo& Info = Geometry.GetInfo();
	const bool bShort = !Part.bPieces && Geometry.GetIndexType() == ERTIndexType::UInt16;
	const uint64_t Whole = Geometry.GetIndices()->GetDeviceAddress() + Geometry.GetIndicesOffset();
	const uint64_t First = Part.bPieces ? Info.PieceIndices->GetDeviceAddress() : Whole;
	const uint64_t Indices = First + uint64_t(Part.FirstIndex) * (bShort ? 2 : 4);
	Data.Positions = Info.Positions->GetDeviceAddress() + Info.PositionsOffset;
	Data.Attributes = Info.Attributes->GetDeviceAddress() + Info.AttributesOffset;
	if (Info.bStreams)
	{
		Data.Attributes += Part.Section * sizeof(FVertexStreams);
		Data.Flags |= SECTION_STREAMS;
	}
	Data.Indices = Indices & ~uint64_t(3); // shaders read whole words
	Data.Flags |= bShort ? SECTION_INDEX_16 : 0u;
	Data.Flags |= Indices & 2 ? SECTION_INDEX_ODD : 0u;
}

bool MayBePieces(const FRTGeometry& Geometry, const FRTGeometryPart& Part)
{
	return Part.bPieces || Geometry.GetInfo().Sections[Part.Section].PieceCount > 0;
}

/// Tells whether the alpha test needs neither a transform of texture coordinates nor the alpha of vertices.
bool HasPlainOpacity(const FRTGeometryInfo& Info, const FMaterialData& Material)
{
	return Info.bOpaqueVertices && Material.UVTransform[TEXTURE_BASE_COLOR] == glm::vec4(1, 0, 0, 1) &&
	       Material.UVOffset[TEXTURE_BASE_COLOR] == glm::vec2(0);
}
bool IsAlphaTested(const FSectionContext& Context, const FRTGeometryPart& Part, const FMaterialData& Material)
{
	if ((Material.Flags & MATERIAL_BLENDED) != 0 && IsTransmissive(Context, Material)) { return false; }
	return Context.bAlphaTest && Context.Override != 2 && !Part.bOpaque && (Material.Flags & MATERIAL_MASKED) != 0;
}
} // namespace

bool IsTransmissive(const FSectionContext& Context, const FMaterialData& Material)
{
	return Context.bTransmission && Context.Override == 0 && LightShinesThrough(Material);
}

bool IsScattering(const FSectionContext& Context, const FMaterialData& Material)
{
	const bool bSolid = IsTransmissive(Context, Material) && (Material.Flags & MATERIAL_SOLID) != 0;
	return bSolid && Material.Extinction * Material.ScatterAlbedo != glm::vec3(0);
}

bool MayListEmissive(const FRTGeometry& Geometry, uint32_t Section)
{
	const FRTGeometryInfo& Info = Geometry.GetInfo();
	return !Info.Sections[Section].bProcedural && !Geometry.IsCoarse() && !Info.bWaitsForData;
}

FHitProgram ChooseHitProgram(const FSectionContext& Context, const FRTGeometry& Geometry, const FRTGeometryPart& Part, uint32_t Material)
{
	const uint32_t Program = Material < Context.Programs.size() ? Context.Programs[Material] : StandardProgram;
	if (Geometry.GetInfo().Sections[Part.Section].bProcedural) { return {Program, ERTHitClass::Procedural}; }
	const FMaterialData& Data = Context.Materials[Material];
	if (!Part.bOpaque && IsTransmissive(Context, Data)) { return {Program, ERTHitClass::Masked}; }
	if (!IsAlphaTested(Context, Part, Data)) { return {Program, ERTHitClass::Opaque}; }
	const FRTGeometryInfo& Info = Geometry.GetInfo();
	const bool bPlain = Program == StandardProgram && HasPlainOpacity(Info, Data) && !Info.bStreams && !MayBePieces(Geometry, Part);
	return {Program, bPlain ? ERTHitClass::MaskedPlain : ERTHitClass::Masked};
}

FSectionData MakeSection(const FSectionContext& Context, const FRTGeometry& Geometry, const FRTGeometryPart& Part, uint32_t MaterialIndex)
{
	const FRTGeometryInfo& Info = Geometry.GetInfo();
	const FMaterialData& Material = Context.Materials[MaterialIndex];
	const ERTHitClass Class = ChooseHitProgram(Context, Geometry, Part, MaterialIndex).Class;
	FSectionData Data{};
	if (Class == ERTHitClass::Procedural)
	{
		Data.Positions = Info.Aabbs->GetDeviceAddress() + Info.AabbsOffset + Part.FirstIndex * AabbBytes;
	}
	else { AddTriangles(Geometry, Part, Data); }
	Data.Material = MaterialIndex;
	if (Class != ERTHitClass::Procedural)
	{
		Data.Flags |= IsAlphaTested(Context, Part, Material) ? SECTION_MASKED : 0u;
		Data.Flags |= !Part.bOpaque && IsTransmissive(Context, Material) ? SECTION_TRANSMISSIVE : 0u;
	}
	Data.Flags |= Info.Sections[Part.Section].PieceCount > 0 ? SECTION_PIECES : 0u;
	Data.Flags |= Part.bPieces ? SECTION_IS_PIECES : 0u;
	Data.Flags |= Material.UVSets & (1u << TEXTURE_BASE_COLOR) ? SECTION_OPACITY_UV1 : 0u;
	Data.Flags |= HasPlainOpacity(Info, Material) ? SECTION_PLAIN_OPACITY : 0u;
	Data.Flags |= Material.Flags & MATERIAL_DOUBLE_SIDED ? SECTION_DOUBLE_SIDED : 0u;
	Data.Flags |= Info.bHasTangents ? SECTION_TANGENTS : 0u;
	Data.Flags |= Material.EmissiveWeight > 0.0f && MayListEmissive(Geometry, Part.Section) ? SECTION_LIGHT : 0u;
	return Data;
}

} // namespace Lantern
