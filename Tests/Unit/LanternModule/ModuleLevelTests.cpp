// Levels of detail that an engine chooses, and what it knows of an object's future.
#include <algorithm>

#include "ModuleTestTools.h"

namespace Lantern
{
namespace
{

class FModuleLevelTest : public FModuleTest
{
protected:
	ERTMeshHandle AddNamed(const char* Name)
	{
		FRTModuleMesh Mesh = DescribeTriangle();
		Mesh.Name = Name;
		return AddMesh(Mesh);
	}
	void RenderUntilComplete()
	{
		EXPECT_TRUE(WaitUntil(
		    "a complete frame", [&] { return Outputs.bComplete; },
		    [&] {
			ASSERT_OK(RenderWholeFrame());
			GiveWay();
		    }));
	}
	/// Names of the geometries that rays can meet, by instance.
	std::vector<std::string> FindShown()
	{
		std::vector<std::string> Out;
		for (IRTScene* const Scene : Mock().FindLiveScenes())
		{
			for (const FRTMockInstance& Instance : Mock().GetSceneInstances(Scene)) { Out.push_back(Instance.GeometryName); }
		}
		return Out;
	}
	using FNames = std::vector<std::string>;
};

TEST_F(FModuleLevelTest, AnObjectChangesItsLevelAndNothingElse)
{
	const ERTMeshHandle Near = AddNamed("Fine"), Coarse = AddNamed("Coarse");
	ASSERT_OK(AddObject(Near, Solid));
	ASSERT_OK(SetSun(-1.0));
	RenderUntilComplete();
	EXPECT_EQ(FindShown(), FNames{"Fine"});
	const FObjectData Before = ReadEntry<FObjectData>(ReadConstants(DescribeFrame()).Objects, 0);
	ASSERT_OK(Renderer->SetObjectMesh(Object, Coarse, &Solid, 1));
	ASSERT_OK(RenderWholeFrame());
	EXPECT_EQ(FindShown(), FNames{"Coarse"}) << "it is built already";
	const FObjectData After = ReadEntry<FObjectData>(ReadConstants(DescribeFrame()).Objects, 0);
	EXPECT_EQ(std::memcmp(Before.ObjectToWorld, After.ObjectToWorld, sizeof(Before.ObjectToWorld)), 0);
	EXPECT_EQ(After.Motion, NO_MOTION);
	ASSERT_OK(RenderWholeFrame());
	EXPECT_EQ(FindShown(), FNames{"Coarse"}) << "the level stays while the engine says nothing";
	EXPECT_REFUSED(Renderer->RemoveMesh(Coarse), "1 objects still use");
	ASSERT_OK(Renderer->RemoveMesh(Near));
	ASSERT_OK(RenderWholeFrame());
}

TEST_F(FModuleLevelTest, RaysSeeTheOldLevelUntilTheNewOneIsBuilt)
{
	const ERTMeshHandle Near = AddNamed("Fine");
	ASSERT_OK(AddObject(Near, Solid));
	const ERTObjectHandle Mine = Object;
	ASSERT_OK(SetSun(-1.0));
	RenderUntilComplete();
	// Others are built first, one in each frame: no object shows the new level yet.
	SetVariable("r.RT.Build.TrianglesPerFrame", "1");
	for (int Other = 0; Other < 4; ++Other) { ASSERT_OK(AddObject(AddNamed("Other"), Solid)); }
	const ERTMeshHandle Coarse = AddNamed("Coarse");
	ASSERT_OK(Renderer->SetObjectMesh(Mine, Coarse, &Solid, 1));
	ASSERT_OK(Renderer->RemoveMesh(Near)); // no object has it any more
	int Old = 0, New = 0;
	EXPECT_TRUE(WaitUntil(
	    "the new level", [&] { return New > 0; },
	    [&] {
		ASSERT_OK(RenderWholeFrame());
		const FNames Shown = FindShown();
		Old = static_cast<int>(std::count(Shown.begin(), Shown.end(), "Fine"));
		New = static_cast<int>(std::count(Shown.begin(), Shown.end(), "Coarse"));
		ASSERT_EQ(Old + New, 1) << "there is always one";
		GiveWay();
	    }));
}

TEST_F(FModuleLevelTest, WhatTheOldLevelNeededMayGo)
{
	ERTMaterialHandle Old = ERTMaterialHandle::None;
	ASSERT_OK(Renderer->AddMaterial({}, &Old));
	ASSERT_OK(AddObject(AddNamed("Fine"), Old));
	ASSERT_OK(SetSun(-1.0));
	RenderUntilComplete();
	SetVariable("r.RT.Build.TrianglesPerFrame", "1");
	ASSERT_OK(Renderer->SetObjectMesh(Object, AddNamed("Coarse"), &Solid, 1));
	ASSERT_OK(Renderer->SetObjectMaterials(Object, &Masked, 1));
	ASSERT_OK(Renderer->RemoveMaterial(Old));
	for (int Frame = 0; Frame < 4; ++Frame) { ASSERT_OK(RenderWholeFrame()); }
	RenderUntilComplete();
	EXPECT_EQ(FindShown(), FNames{"Coarse"});
	ASSERT_OK(Renderer->RemoveObject(Object));
	ASSERT_OK(RenderWholeFrame());
}

TEST_F(FModuleLevelTest, AnObjectMayGoWhileItsLevelIsOnItsWay)
{
	ASSERT_OK(AddObject(AddNamed("Fine"), Solid));
	ASSERT_OK(SetSun(-1.0));
	RenderUntilComplete();
	ASSERT_OK(Renderer->SetObjectMesh(Object, AddNamed("Coarse"), &Solid, 1));
	ASSERT_OK(RenderWholeFrame());
	ASSERT_OK(Renderer->RemoveObject(Object));
	for (int Frame = 0; Frame < 4; ++Frame) { ASSERT_OK(RenderWholeFrame()); }
	EXPECT_EQ(FindShown(), FNames{});
}

TEST_F(FModuleLevelTest, WhatIsSaidToStandStillIsNotMoved)
{
	FRTModuleObject Desc;
	Desc.Mesh = AddNamed("Wall");
	Desc.Materials = &Solid;
	Desc.MaterialCount = 1;
	for (const ERTModuleMobility Mobility : {ERTModuleMobility::Static, ERTModuleMobility::Stationary, ERTModuleMobility::Movable})
	{
		Desc.Mobility = Mobility;
		ASSERT_OK(Renderer->AddObject(Desc, &Object));
		const double Moved[12] = {1, 0, 0, 5, 0, 1, 0, 0, 0, 0, 1, 0};
		if (Mobility == ERTModuleMobility::Movable) { ASSERT_OK(Renderer->SetObjectTransform(Object, Moved)); }
		else { EXPECT_REFUSED(Renderer->SetObjectTransform(Object, Moved), "Mobility is not Movable"); }
	}
	Desc.Mobility = static_cast<ERTModuleMobility>(3);
	EXPECT_REFUSED(Renderer->AddObject(Desc, &Object), "Mobility");
}

} // namespace
} // namespace Lantern
