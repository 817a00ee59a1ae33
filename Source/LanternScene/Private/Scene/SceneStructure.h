// FSceneStructure keeps the acceleration structure over a scene's instances (TLAS). It gathers the instances as tasks,
// and records the build over them.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "LanternCore/Tasks/Tasks.h"
#include "LanternScene/Geometry/GeometryStore.h"
#include "LanternScene/Instances/Gather.h"
#include "LanternScene/Instances/InstanceUploads.h"
#include "LanternScene/Scene/SceneObjects.h"

namespace Lantern
{

/// Threads: one at a time. Objects must not change between StartGather and FinishGather.
class FSceneStructure
{
public:
	/// The arguments outlive this. Geometries gives scratch memory, and is told which geometries are missing.
	FSceneStructure(IRTDevice& InDevice, FGeometryStore& InGeometries, const FSceneObjects& InObjects);
	~FSceneStructure();
	FSceneStructure(const FSceneStructure&) = delete;
	FSceneStructure& operator=(const FSceneStructure&) = delete;

	/// Tells whether a gather for this view may give another acceleration structure than the one that was built last.
	bool NeedsGather(const FGatherView& View, bool bCull, const glm::dvec3& Origin) const;
	/// Starts gathering unless the newest instances are those of this view. bCull: as FSceneUse::bCull.
	void StartGather(const FGatherView& View, bool bCull, const glm::dvec3& Origin);
	/// Waits for the gather, if one was started, and returns its status.
	FRTStatus FinishGather();
	/// Tells whether StartGather started one that FinishGather has not waited for.
	bool IsGathering() const { return bGathering; }
	/// Tells whether the structure is not over the newest instances. Not while gathering.
	bool IsStale() const { return bStructureStale; }
	/// Makes the structure large enough and records its build over the newest instances, with barriers.
	FRTStatus Build(IRTCommandList& List);
	/// bSubmitted and Fence are as in FRTScene::EndFrame.
	void EndFrame(bool bSubmitted, FRTFence Fence);

	/// Null before the first Build.
	IRTScene* Get() const { return Structure.Get(); }
	/// Instances of the last Build.
	uint32_t GetInstanceCount() const { return StructureCount; }

private:
	/// All that the instances written depend on beside the content of the store.
	struct FGatherKey
	{
		FGatherView View;
		FCullingSettings Culling;
		glm::dvec3 Origin{0};
		uint64_t Revision = 0;
		int32_t Mode = -1;
		friend bool operator==(const FGatherKey&, const FGatherKey&) = default;
	};
	FGatherKey MakeKey(const FGatherView& View, bool bCull, const glm::dvec3& Origin) const;
	FRTStatus Gather(const FGatherKey& Key, const FGatherKey& Before);
	FRTStatus Reserve(uint32_t InstanceCount);

	IRTDevice& Device;
	FGeometryStore& Geometries;
	const FSceneObjects& Objects;
	FInstanceGather InstanceGather;
	FInstanceUploads Uploads{Device};
	FGatherKey GatheredKey;
	// Tasks of a gather write these. They are read when it is finished.
	FRTStatus GatherStatus;
	uint32_t GatheredCount = 0;
	bool bInstancesStale = true; // the newest instances written are not what GatheredKey says
	bool bStructureStale = true; // the structure is not over the newest instances, or was never built
	bool bGathering = false;

	TRTRef<IRTScene> Structure;
	uint32_t StructureCount = 0;
	uint32_t FramesTooLarge = 0;
	FTaskGroup GatherTasks; // last: it waits for what uses the others
};

} // namespace Lantern
