// rtGeometry: triangles in sections, and the acceleration structure over them. It knows nothing of shaders or
// materials; any number of objects may share it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "LanternRHI/RTInterfaces.h"

namespace Lantern
{

struct FRTSectionInfo
{
	uint32_t FirstIndex = 0;
	uint32_t IndexCount = 0; ///< > 0, a multiple of 3
	/// False where some object may give this section an alpha-tested material: any-hit shaders then run on it.
	bool bOpaque = true;
};

/// Where a geometry's data lies. Buffers need ERTBufferUsage::GeometryInput and Storage.
struct FRTGeometryInfo
{
	std::string Name;
	TRTRef<IRTBuffer> Positions;  ///< float3
	uint64_t PositionsOffset = 0; ///< bytes, a multiple of 4
	TRTRef<IRTBuffer> Attributes; ///< FVertexAttributes
	uint64_t AttributesOffset = 0;
	TRTRef<IRTBuffer> Indices;
	uint64_t IndicesOffset = 0; ///< bytes, a multiple of 4
	ERTIndexType IndexType = ERTIndexType::UInt32;
	uint32_t VertexCount = 0;
	std::vector<FRTSectionInfo> Sections; ///< > 0
	bool bHasTangents = false;
	/// The alpha of every vertex colour is 1: alpha tests then do not read it. False is always right.
	bool bOpaqueVertices = false;
	/// Vertices change after creation (skinning): call FRTScene::MarkDeformed when they did.
	bool bDynamic = false;
	/// The same data on the CPU, alive as long as the geometry; null: its emissive triangles are found by chance
	/// alone, not by light sampling. Ignored for dynamic geometry.
	const glm::vec3* CpuPositions = nullptr;
	const uint32_t* CpuIndices = nullptr;
};

class FRTGeometry
{
public:
	const FRTGeometryInfo& GetInfo() const { return Info; }
	/// Null before the first build.
	IRTGeometry* GetStructure() const { return Structure.Get(); }
	bool IsBuilt() const { return bBuilt; }
	uint32_t GetSectionCount() const { return static_cast<uint32_t>(Info.Sections.size()); }

private:
	friend class FRTScene;
	friend class FGeometryBuilder;
	FRTGeometryInfo Info;
	TRTRef<IRTGeometry> Structure;
	bool bBuilt = false;
	bool bDeformed = false;
	uint32_t RefitsSinceBuild = 0;
};

using FRTGeometryRef = std::shared_ptr<FRTGeometry>;

} // namespace Lantern
