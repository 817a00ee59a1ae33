// Where a scene's origin is, what it costs to move it, and how far from their own origins objects reach.
#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "Support/SceneTestTools.h"

namespace Lantern
{
namespace
{

double MaxNorm(const glm::dvec3& V) { return std::max({std::abs(V.x), std::abs(V.y), std::abs(V.z)}); }

class FSceneOriginTest : public FSceneTest
{
protected:
	glm::dvec3 GetOriginOfShaders() const
	{
		const FSceneConstants C = Scene->GetConstants();
		return CellCenter(C.OriginCell) + glm::dvec3(C.OriginInCell);
	}
	/// A sphere around its pivot.
	FRTObjectId AddSphere(double Radius, const glm::dvec3& Pivot)
	{
		FRTGeometryInfo Info = MakeInfo("Sphere", 1);
		Info.BoundsRadius = static_cast<float>(Radius);
		FRTGeometryRef Geometry;
		EXPECT_TRUE(Scene->CreateGeometry(std::move(Info), Geometry));
		return Add(Geometry, {Scene->AddMaterial(MakeMaterial())}, Pivot);
	}
};

// Rays are as precise as coordinates near the camera are small.
TEST_F(FSceneOriginTest, OriginIsWithinFiftyMetresOfTheCamera)
{
	std::mt19937 Random(3);
	std::uniform_real_distribution<double> Far(-32'000.0, 32'000.0), Step(-40.0, 40.0);
	for (int Try = 0; Try < 40; ++Try)
	{
		glm::dvec3 Eye(Far(Random), Far(Random), Far(Random));
		for (int I = 0; I < 20; ++I)
		{
			Eye += glm::dvec3(Step(Random), Step(Random), Step(Random));
			Frame(Eye);
			ASSERT_LE(MaxNorm(Eye - Scene->GetOrigin()), 50.0) << "try " << Try << ", step " << I;
			ASSERT_EQ(GetOriginOfShaders(), Scene->GetOrigin());
			ASSERT_LE(MaxNorm(glm::dvec3(Scene->GetConstants().OriginInCell)), 0.5 * CellSize);
		}
	}
}

TEST_F(FSceneOriginTest, NoCameraIsTooFarAway)
{
	for (const double X : {1e9, -1e15, 1e300, std::nan("")})
	{
		EXPECT_TRUE(std::isfinite(MaxNorm(FindOrigin({X, 0, 0})))) << X;
		EXPECT_EQ(FindOrigin({0, X, 100})[2], 128.0) << X;
	}
	EXPECT_EQ(FindOrigin({16'031.9, -0.1, 512.0})[0], 16'000.0);
	EXPECT_EQ(FindOrigin({16'032.1, -33.0, 512.0}), glm::dvec3(16'064.0, -64.0, 512.0));
}

TEST_F(FSceneOriginTest, ToAndFroAcrossABorderMovesItOnce)
{
	const glm::dvec3 Border(0.5 * FRTScene::OriginStep, 0, 0);
	Frame({});
	int Moves = 0;
	for (int I = 0; I < 40; ++I)
	{
		const glm::dvec3 Before = Scene->GetOrigin();
		Frame(Border + glm::dvec3(I % 2 ? 15.0 : -15.0, 0, 0));
		Moves += Scene->GetOrigin() == Before ? 0 : 1;
	}
	EXPECT_LE(Moves, 1);
}

// A flight at 200 m/s moves it three times a second: tables of objects and of emissive triangles stay as they are.
TEST_F(FSceneOriginTest, MovingItRewritesNoTable)
{
	const FRTGeometryRef Panel = MakeGeometry("Panel", 1, {.bCpuData = true, .TrianglesPerSection = 50});
	const FRTObjectId Id = Add(Panel, {Scene->AddMaterial(MakeMaterial(0, 1.0f))}, {700.25, 0, 3});
	FSceneUse Use;
	Use.bLightSampling = true;
	Frame({600, 0, 0}, Use);
	ASSERT_EQ(Scene->GetConstants().EmissiveTriangleCount, 50u);
	for (int I = 0; I < 3; ++I) { Frame({600, 0, 0}, Use); }
	Mock().ClearCalls();
	for (int I = 1; I <= 10; ++I)
	{
		const glm::dvec3 Before = Scene->GetOrigin();
		Frame({600 + 97 * I, 0, 0}, Use);
		ASSERT_NE(Scene->GetOrigin(), Before);
		EXPECT_EQ(Scene->GetStats().BytesCopied, 0u);
		EXPECT_EQ(EmissiveWork, 0u) << "emissive triangles stay where they are in their cells";
	}
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::CopyBuffer), 0u);
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::BuildScene), 10u) << "instances are relative to it";
	for (int I = 0; I < 3; ++I) { Scene->AddLight({}); }
	Frame({1280, 0, 0}, Use);
	Frame({1344, 0, 0}, Use);
	EXPECT_EQ(Scene->GetStats().BytesCopied, 0u);
	// What moves takes its triangles with it, into the next cell as well.
	glm::dmat4 There(1.0);
	There[3] = {2000.5, 0, 3, 1};
	Scene->SetTransform(Id, There);
	Frame({1344, 0, 0}, Use);
	EXPECT_EQ(EmissiveWork, Scene->GetConstants().EmissiveClusterCount);
}

// Raster and motion vectors know where an object is to a fraction of a unit in the last place.
TEST_F(FSceneOriginTest, WhatRoundingTakesFromATranslationIsKept)
{
	const uint32_t Material = Scene->AddMaterial(MakeMaterial());
	const FRTGeometryRef Tree = MakeGeometry("Tree", 1);
	std::mt19937 Random(11);
	std::uniform_real_distribution<double> Far(-32'000.0, 32'000.0);
	for (int Try = 0; Try < 200; ++Try)
	{
		const glm::dvec3 At(Far(Random), Far(Random), Far(Random));
		const FRTObjectId Id = Add(Tree, {Material}, At);
		Frame(At);
		const FObjectData Data = Read<FObjectData>(Scene->GetConstants().Objects, Id.Index);
		EXPECT_EQ(Data.Flags & 3u, 0u);
		for (int Axis = 0; Axis < 3; ++Axis)
		{
			const auto Steps = static_cast<int32_t>(Data.Flags << (20 - 10 * Axis)) >> 22;
			const double Found = CellCenter(Data.Cell)[Axis] + double(Data.ObjectToWorld[Axis].w) + std::ldexp(double(Steps), -25);
			ASSERT_NEAR(Found, At[Axis], std::ldexp(1.01, -25));
		}
		Scene->RemoveObject(Id);
	}
}

TEST_F(FSceneOriginTest, ReachIsThatOfLargeObjectsFarFromTheirPivots)
{
	AddSphere(3.0, {500, 0, 0});
	Frame({});
	EXPECT_EQ(Scene->GetConstants().ObjectReach, float(FObjectPivots::LeastReach)) << "small ones do not count";
	const FRTObjectId Terrain = AddSphere(1000.0, {0, 0, 0});
	Frame({});
	EXPECT_EQ(Scene->GetConstants().ObjectReach, float(FObjectPivots::LeastReach)) << "its pivot is the origin";
	Frame({640, 0, 0});
	EXPECT_EQ(Scene->GetConstants().ObjectReach, 640.0f);
	Frame({960, 0, 0});
	EXPECT_EQ(Scene->GetConstants().ObjectReach, 960.0f);
	Frame({1984, 0, 0});
	EXPECT_EQ(Scene->GetConstants().ObjectReach, 1000.0f) << "its rim is as far from the pivot as that";
	Frame({2048, 0, 0});
	EXPECT_EQ(Scene->GetConstants().ObjectReach, float(FObjectPivots::LeastReach)) << "all of it has coordinates larger than that";
	Frame({640, 0, 0});
	Scene->RemoveObject(Terrain);
	Frame({640, 0, 0});
	EXPECT_EQ(Scene->GetConstants().ObjectReach, float(FObjectPivots::LeastReach));
}

TEST(FObjectPivotsTest, AreWhatALookAtAllOfThemFinds)
{
	struct FItem
	{
		glm::dvec3 Pivot, Center;
		double Radius;
	};
	std::mt19937 Random(8);
	std::uniform_real_distribution<double> Place(-3000.0, 3000.0), Size(-1.0, 3.0), Shift(-200.0, 200.0);
	const auto MakePlace = [&] { return glm::dvec3(Place(Random), Place(Random), Place(Random)); };
	FObjectPivots Pivots;
	std::map<uint32_t, FItem> Items;
	for (int Step = 0; Step < 3000; ++Step)
	{
		const uint32_t Object = Random() % 40;
		if (Random() % 4 == 0)
		{
			Pivots.Remove(Object);
			Items.erase(Object);
		}
		else
		{
			FItem& Item = Items[Object];
			Item.Pivot = MakePlace();
			Item.Center = Item.Pivot + glm::dvec3(Shift(Random), 0, Shift(Random)) * double(Random() % 2);
			Item.Radius = Random() % 10 == 0 ? -1.0 : std::pow(10.0, Size(Random));
			Pivots.Set(Object, Item.Pivot, Item.Center, Item.Radius);
		}
		if (Random() % 3 != 0) { continue; }
		const glm::dvec3 Origin = Random() % 2 ? FindOrigin(MakePlace()) : glm::dvec3(0);
		Pivots.Update(Origin);
		double Expected = FObjectPivots::LeastReach;
		for (const auto& [Index, Item] : Items)
		{
			const double Here = std::min(MaxNorm(Item.Pivot - Origin), MaxNorm(Item.Center - Item.Pivot) + Item.Radius);
			if (Item.Radius >= 0.0 && MaxNorm(Item.Center - Origin) - Item.Radius < Here) { Expected = std::max(Expected, Here); }
		}
		ASSERT_EQ(Pivots.GetReach(), static_cast<float>(Expected)) << "step " << Step;
	}
}

} // namespace
} // namespace Lantern
