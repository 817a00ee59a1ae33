// A mesh whose vertices the engine replaces now and then: what is new of it, and its way to the GPU.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "LanternModule/Module.h"
#include "LanternScene/Geometry/Geometry.h"
#include "LanternScene/Memory/Upload.h"
#include "MeshData.h"
#include "SceneTypes.h"

namespace Lantern
{

class FDeformableMesh
{
public:
	/// Mesh: checked. Data: as PackMesh made it.
	FDeformableMesh(const FRTModuleMesh& Mesh, const FMeshData& Data);
	/// As IRTModuleRenderer::UpdateMeshVertices. OutNew: no vertices were waiting before. Any thread.
	FRTStatus SetVertices(const float* InPositions, const float* Normals, bool& OutNew);

	// Render thread.
	/// Returns the bounds of the vertices set last if those of Geometry no longer fit: they leave vertices out, or are far too
	/// large. Bounds that the engine gave always fit.
	std::optional<FBoundingSphere> FindNewBounds(const FRTGeometry& Geometry) const;
	/// Copies the vertices that wait. On an error the list must not be submitted.
	FRTStatus Record(IRTCommandList& List, FFrameUploads& Uploads, const FRTGeometryInfo& Info);
	/// bSubmitted: false if what was recorded never runs. Its vertices then wait again, unless there are newer ones, and the
	/// result is true.
	bool EndFrame(bool bSubmitted);

private:
	struct FVertices
	{
		std::vector<glm::vec3> Positions;
		std::vector<FVertexAttributes> Attributes;
	};
	const std::string Name;
	const std::shared_ptr<const FMeshShape> Shape; ///< as added
	const std::vector<FVertexAttributes> Base;     ///< attributes as added; the normals are replaced
	const bool bFindsBounds;                       ///< the engine gave none
	std::shared_ptr<const FVertices> Recorded;     ///< last; render thread
	std::mutex Mutex;
	std::shared_ptr<const FVertices> Waiting; ///< set since then; guarded by Mutex
};
using FDeformableMeshRef = std::shared_ptr<FDeformableMesh>;

} // namespace Lantern
