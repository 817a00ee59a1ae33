// A mesh whose vertices the engine replaces now and then: what is new of it, and its way to the GPU.
#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "LanternModule/Module.h"
#include "LanternScene/Geometry/Geometry.h"
#include "LanternScene/Memory/Upload.h"
#include "SceneTypes.h"

namespace Lantern
{

class FDeformableMesh
{
public:
	/// Mesh: checked. Attributes: as PackAttributes made them.
	FDeformableMesh(const FRTModuleMesh& Mesh, std::vector<FVertexAttributes> InAttributes, FRTGeometryRef InGeometry);
	/// As IRTModuleRenderer::UpdateMeshVertices.
	FRTStatus SetVertices(const float* InPositions, const float* Normals);
	/// There are vertices that the GPU does not have.
	bool IsPending() const { return State == EState::Pending; }
	/// Copies them in List. On an error the list must not be submitted.
	FRTStatus Record(IRTCommandList& List, FFrameUploads& Uploads);
	/// bSubmitted: false when what was recorded will never run.
	void EndFrame(bool bSubmitted);

private:
	enum class EState
	{
		Clean,
		Pending,
		Recorded,
	};
	FRTGeometryRef Geometry;
	std::vector<uint32_t> Indices;
	std::vector<glm::vec3> Positions;
	std::vector<FVertexAttributes> Attributes;
	EState State = EState::Clean;
};

} // namespace Lantern
