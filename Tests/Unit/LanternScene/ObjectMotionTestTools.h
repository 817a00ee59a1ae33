// For tests of motion: frames that follow it, lost frames, and what the device has of it.
#pragma once

#include <string>

#include <glm/gtc/matrix_transform.hpp>

#include "Support/SceneTestTools.h"

namespace Lantern
{

class FObjectMotionTest : public FSceneTest
{
protected:
	static FSceneUse MakeUse(bool bMotion = true)
	{
		FSceneUse Use;
		Use.bMotion = bMotion;
		return Use;
	}
	void SetUp() override
	{
		FSceneTest::SetUp();
		Material = Scene->AddMaterial(MakeMaterial());
		Tree = MakeGeometry("Tree", 1);
	}
	void Show(glm::dvec3 Camera = {}) { Frame(Camera, MakeUse()); }
	void Rest()
	{
		Show();
		Settle({}, MakeUse());
	}
	/// Recorded, and never run.
	void Lose(bool bMotion = true)
	{
		TRTRef<IRTCommandList> List;
		EXPECT_TRUE(Device->CreateCommandList("Lost", List.ReleaseAndGetAddress()));
		EXPECT_TRUE(List->Begin());
		Scene->RefreshFacts();
		if (Scene->NeedsUpdate(glm::dvec3(0), MakeUse(bMotion)))
		{
			EXPECT_TRUE(Scene->Update(*List, *Uploads, glm::dvec3(0), MakeUse(bMotion)));
		}
		EXPECT_TRUE(List->End());
		Uploads->EndFrame(0);
		Scene->EndFrame(false);
	}
	FObjectData ReadObject(FRTObjectId Id) { return Read<FObjectData>(Scene->GetConstants().Objects, Id.Index); }
	bool HasMotion(FRTObjectId Id) { return ReadObject(Id).Motion != NO_MOTION; }
	FObjectMotion ReadMotion(FRTObjectId Id)
	{
		const uint32_t Entry = ReadObject(Id).Motion;
		EXPECT_LT(Entry, Scene->GetMotions().GetTable().Num());
		return Read<FObjectMotion>(Scene->GetConstants().ObjectMotions, Entry);
	}
	static glm::dvec3 GetPreviousPlace(const FObjectMotion& Motion)
	{
		const glm::dvec3 InCell(Motion.PreviousObjectToWorld[0].w, Motion.PreviousObjectToWorld[1].w, Motion.PreviousObjectToWorld[2].w);
		return InCell + CellCenter(Motion.PreviousCell);
	}
	void Move(FRTObjectId Id, glm::dvec3 Place) { Scene->SetTransform(Id, glm::translate(glm::dmat4(1.0), Place)); }
	FRTGeometryRef MakeDeformable(const std::string& Name)
	{
		FRTGeometryInfo Info = MakeInfo(Name, 1, {.bDynamic = true});
		Info.PreviousPositions = MakeBuffer(Name + " before", Info.VertexCount * 12);
		FRTGeometryRef Geometry;
		EXPECT_TRUE(Scene->CreateGeometry(std::move(Info), Geometry));
		return Geometry;
	}
	static FAddress PreviousPositionsOf(const FRTGeometryRef& Geometry)
	{
		return Geometry->GetInfo().PreviousPositions->GetDeviceAddress();
	}

	uint32_t Material = 0;
	FRTGeometryRef Tree;
};

} // namespace Lantern
