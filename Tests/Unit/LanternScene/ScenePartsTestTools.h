// For the tests of a scene's parts: the parts without FRTScene, on a mock device.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "LanternScene/Scene/EmissiveTriangles.h"
#include "LanternScene/Scene/SceneLights.h"
#include "LanternScene/Scene/SceneMaterials.h"
#include "LanternScene/Scene/SceneObjects.h"
#include "Support/SceneTestTools.h"

namespace Lantern
{

class FScenePartsTest : public FSceneTest
{
protected:
	void SetUp() override
	{
		FSceneTest::SetUp();
		Geometries = std::make_unique<FGeometryStore>(*Device);
	}
	/// A geometry whose structure Geometries builds.
	FRTGeometryRef Create(uint32_t SectionCount, const FGeometryOptions& Options = {})
	{
		FRTGeometryRef Geometry;
		const FRTStatus Status = Geometries->Create(MakeInfo("Part", SectionCount, Options), Geometry);
		EXPECT_TRUE(Status) << Status.Message;
		return Geometry;
	}
	FRTObjectId Place(FRTGeometryRef Geometry, std::vector<uint32_t> OfSections, glm::dvec3 Position = {})
	{
		FRTObjectInfo Info;
		Info.Geometry = std::move(Geometry);
		Info.Materials = std::move(OfSections);
		Info.Transform[3] = glm::dvec4(Position, 1.0);
		return Objects.Add(std::move(Info));
	}
	void UpdateEmissive()
	{
		const FRTStatus Status = Emissive.Update(*Device, Objects, Materials);
		EXPECT_TRUE(Status) << Status.Message;
		const FEmissiveWork Work = Emissive.GetWork();
		Done = Work.Clusters ? *Work.Clusters : std::vector<uint32_t>();
		DoneCount = Work.Count;
		Emissive.EndFrame(true);
		EXPECT_FALSE(Emissive.NeedsUpdate());
	}

	std::unique_ptr<FGeometryStore> Geometries;
	FEmissiveTriangles Emissive;
	std::vector<uint32_t> Done; // clusters that the GPU had to do after the last UpdateEmissive; none: all
	uint32_t DoneCount = 0;
	FSceneMaterials Materials{Emissive};
	FSceneObjects Objects{Materials.GetSections(), Emissive};
	FSceneLights Lights;
};

} // namespace Lantern
