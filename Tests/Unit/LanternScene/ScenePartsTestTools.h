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
		Emissive.Update(Objects, Materials);
		EXPECT_FALSE(Emissive.NeedsUpdate());
	}

	std::unique_ptr<FGeometryStore> Geometries;
	FEmissiveTriangles Emissive;
	FSceneMaterials Materials{Emissive};
	FSceneObjects Objects{Materials.GetSections(), Emissive};
	FSceneLights Lights;
};

} // namespace Lantern
