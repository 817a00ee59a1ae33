// Landscapes of patches: their vertices, their borders, and what an edit costs.
#include <cmath>
#include <functional>

#include "ModuleTestTools.h"

namespace Lantern
{
namespace
{

class FModuleLandscapeTest : public FModuleTest
{
protected:
	static constexpr uint32_t Samples = 17, Side = 8; ///< along a patch, and patches along the landscape
	static constexpr float Spacing = 1.3f;            ///< no binary fraction: extents are rounded

	static uint16_t GetHeight(uint32_t Column, uint32_t Row)
	{
		return static_cast<uint16_t>(30000.0 + 2000.0 * std::sin(0.11 * Column) * std::cos(0.07 * Row));
	}
	/// Patch (X, Y) of a landscape; neighbours share their samples.
	FRTModuleLandscape Describe(uint32_t X, uint32_t Y)
	{
		Heights.clear();
		for (uint32_t Row = 0; Row < Samples; ++Row)
		{
			for (uint32_t Column = 0; Column < Samples; ++Column)
			{
				Heights.push_back(GetHeight(X * (Samples - 1) + Column, Y * (Samples - 1) + Row));
			}
		}
		Name = "Patch " + std::to_string(X) + " " + std::to_string(Y);
		FRTModuleLandscape Patch;
		Patch.Name = Name.c_str();
		Patch.Heights = Heights.data();
		Patch.Columns = Patch.Rows = Samples;
		Patch.SpacingX = Patch.SpacingY = Spacing;
		Patch.HeightScale = 1.0f / 128;
		Patch.HeightOffset = -200.0f;
		return Patch;
	}
	ERTMeshHandle Add(const FRTModuleLandscape& Patch)
	{
		ERTMeshHandle Out = ERTMeshHandle::None;
		const FRTStatus Status = Renderer->AddLandscape(Patch, &Out);
		EXPECT_TRUE(Status.IsOk()) << Status.Message;
		return Out;
	}
	void Place(ERTMeshHandle Mesh, uint32_t X, uint32_t Y)
	{
		FRTModuleObject Desc;
		Desc.Mesh = Mesh;
		Desc.Materials = &Solid;
		Desc.MaterialCount = 1;
		Desc.Transform[3] = X * GetExtent();
		Desc.Transform[7] = Y * GetExtent();
		ASSERT_OK(Renderer->AddObject(Desc, &Object));
	}
	static double GetExtent() { return double(Samples - 1) * double(Spacing); }
	void RenderUntilComplete()
	{
		EXPECT_TRUE(WaitUntil(
		    "a complete frame", [&] { return Outputs.bComplete; },
		    [&] {
			ASSERT_OK(RenderWholeFrame());
			GiveWay();
		    }));
	}
	/// What the GPU has of a patch.
	std::vector<glm::vec3> ReadPositions(const std::string& Patch, size_t Count = size_t(Samples) * Samples)
	{
		const std::vector<IRTBuffer*> Found = Mock().FindLiveBuffers(Patch);
		EXPECT_EQ(Found.size(), 1u);
		std::vector<glm::vec3> Out(Count);
		std::memcpy(Out.data(), Mock().GetBytes(Found.at(0)), Count * sizeof(glm::vec3));
		return Out;
	}
	std::vector<uint16_t> Heights;
	std::string Name;
};

TEST_F(FModuleLandscapeTest, SamplesBecomeVertices)
{
	constexpr uint16_t Small[] = {0, 10, 20, 99, 30, 40, 50, 99};
	constexpr uint8_t Holes[] = {0, 1};
	FRTModuleLandscape Patch;
	Patch.Name = "Small";
	Patch.Heights = Small;
	Patch.Columns = 3;
	Patch.Rows = 2;
	Patch.RowPitch = 4;
	Patch.SpacingX = 2.0f;
	Patch.SpacingY = 4.0f;
	Patch.HeightScale = 0.5f;
	Patch.HeightOffset = -1.0f;
	Patch.Holes = Holes;
	ASSERT_OK(AddObject(Add(Patch), Solid));
	ASSERT_OK(SetSun(-1.0));
	RenderUntilComplete();
	const std::vector<glm::vec3> Positions = ReadPositions("Small", 6);
	constexpr float Over = 4.0f / (1 << 18); // of the extent, at borders
	const glm::vec3 Expected[] = {
	    {-Over, -Over, -1}, {2, -Over, 4}, {4 + Over, -Over, 9}, {-Over, 4 + Over, 14}, {2, 4 + Over, 19}, {4 + Over, 4 + Over, 24}};
	for (size_t I = 0; I < 6; ++I)
	{
		for (int Axis = 0; Axis < 3; ++Axis) { EXPECT_FLOAT_EQ(Positions[I][Axis], Expected[I][Axis]) << I << " " << Axis; }
	}
	const uint8_t* const Bytes = Mock().GetBytes(Mock().FindLiveBuffers("Small").at(0));
	uint32_t Indices[6];
	std::memcpy(Indices, Bytes + 6 * (12 + sizeof(FVertexAttributes)), sizeof(Indices));
	EXPECT_THAT(Indices, ::testing::ElementsAre(0, 1, 4, 0, 4, 3)) << "the other quad is a hole";
	EXPECT_EQ(Mock().FindLiveBuffers("Small").at(0)->GetDesc().Size, 6 * (12 + sizeof(FVertexAttributes)) + sizeof(Indices));
}

TEST_F(FModuleLandscapeTest, BordersOfNeighboursReachOverEachOther)
{
	for (const uint32_t X : {0u, 1u}) { Place(Add(Describe(X, 0)), X, 0); }
	ASSERT_OK(SetSun(-1.0));
	RenderUntilComplete();
	const std::vector<glm::vec3> Left = ReadPositions("Patch 0 0"), Right = ReadPositions("Patch 1 0");
	for (uint32_t Row = 0; Row < Samples; ++Row)
	{
		const glm::vec3 A = Left[size_t(Row) * Samples + Samples - 1], B = Right[size_t(Row) * Samples];
		EXPECT_GT(double(A.x), GetExtent() + double(B.x)) << "rounding may part them, and they still overlap";
		EXPECT_LT(double(A.x) - (GetExtent() + double(B.x)), 2e-5 * GetExtent());
		EXPECT_EQ(A.z, B.z);
		EXPECT_EQ(A.y, B.y);
	}
}

TEST_F(FModuleLandscapeTest, AnEditCostsItsPatchAlone)
{
	std::vector<ERTMeshHandle> Patches;
	for (uint32_t Index = 0; Index < Side * Side; ++Index)
	{
		Patches.push_back(Add(Describe(Index % Side, Index / Side)));
		Place(Patches.back(), Index % Side, Index / Side);
	}
	ASSERT_OK(SetSun(-1.0));
	RenderUntilComplete();
	const std::vector<glm::vec3> Other = ReadPositions("Patch 4 3");
	const uint16_t Raised[] = {60000, 60001, 0, 60002, 60003, 0};
	FRTModuleHeights Edit;
	Edit.Heights = Raised;
	Edit.FirstColumn = 5;
	Edit.FirstRow = 7;
	Edit.Columns = Edit.Rows = 2;
	Edit.RowPitch = 3;
	ASSERT_OK(Renderer->SetLandscapeHeights(Patches[3 * Side + 3], Edit));
	Mock().ClearCalls();
	Mock().ClearTraffic();
	ASSERT_OK(RenderWholeFrame());
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::BuildGeometry), 1u);
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::BuildGeometry, "Patch 3 3"), 1u);
	EXPECT_EQ(CountCopies("Patch 3 3"), 1u);
	const uint64_t PatchBytes = uint64_t(Samples) * Samples * (12 + sizeof(FVertexAttributes));
	EXPECT_LT(Mock().GetTraffic().Buffer, 2 * PatchBytes) << "the patch, and what a frame copies anyway";
	const std::vector<glm::vec3> Edited = ReadPositions("Patch 3 3");
	for (uint32_t Row = 0; Row < Samples; ++Row)
	{
		for (uint32_t Column = 0; Column < Samples; ++Column)
		{
			const bool bEdited = Row >= 7 && Row < 9 && Column >= 5 && Column < 7;
			const uint32_t Height =
			    bEdited ? Raised[(Row - 7) * 3 + Column - 5] : GetHeight(3 * (Samples - 1) + Column, 3 * (Samples - 1) + Row);
			EXPECT_FLOAT_EQ(Edited[Row * Samples + Column].z, -200.0f + float(Height) / 128) << Column << " " << Row;
		}
	}
	EXPECT_EQ(ReadPositions("Patch 4 3"), Other);
	Mock().ClearCalls();
	ASSERT_OK(RenderWholeFrame());
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::BuildGeometry), 0u);
}

TEST_F(FModuleLandscapeTest, ADeviceIsFollowedWithoutAskingForHeights)
{
	const ERTMeshHandle Patch = Add(Describe(0, 0));
	Place(Patch, 0, 0);
	ASSERT_OK(SetSun(-1.0));
	RenderUntilComplete();
	const uint16_t Peak = 65535;
	FRTModuleHeights Edit;
	Edit.Heights = &Peak;
	Edit.FirstColumn = Edit.FirstRow = 3;
	Edit.Columns = Edit.Rows = 1;
	ASSERT_OK(Renderer->SetLandscapeHeights(Patch, Edit));
	ASSERT_OK(RenderWholeFrame());
	ASSERT_OK(Renderer->Recreate(Device.Get(), {}));
	Outputs = {};
	RenderUntilComplete();
	Device->CollectGarbage();
	EXPECT_FLOAT_EQ(ReadPositions("Patch 0 0")[3 * Samples + 3].z, -200.0f + 65535.0f / 128);
	ASSERT_OK(Renderer->SetLandscapeHeights(Patch, Edit));
	ASSERT_OK(RenderWholeFrame());
}

TEST_F(FModuleLandscapeTest, WhatCannotBeIsNamed)
{
	ERTMeshHandle Out = ERTMeshHandle::None;
	const auto Expect = [&](const char* Part, const std::function<void(FRTModuleLandscape&)>& Change) {
		FRTModuleLandscape Patch = Describe(0, 0);
		Change(Patch);
		EXPECT_REFUSED(Renderer->AddLandscape(Patch, &Out), Part);
	};
	const std::vector<uint8_t> AllHoles(size_t(Samples) * Samples, 1);
	Expect("Columns", [](auto& Patch) { Patch.Columns = 1; });
	Expect("RowPitch", [](auto& Patch) { Patch.RowPitch = Samples - 1; });
	Expect("HolesPitch", [&](auto& Patch) { Patch.Holes = AllHoles.data(), Patch.HolesPitch = 1; });
	Expect("Holes leave nothing", [&](auto& Patch) { Patch.Holes = AllHoles.data(); });
	Expect("SpacingX", [](auto& Patch) { Patch.SpacingX = 0.0f; });
	const ERTMeshHandle Patch = Add(Describe(0, 0));
	FRTModuleHeights Edit{Heights.data(), 16, 0, 2, 1, 0};
	EXPECT_REFUSED(Renderer->SetLandscapeHeights(Patch, Edit), "FirstColumn");
	EXPECT_REFUSED(Renderer->SetLandscapeHeights(AddDeformableMesh(), Edit), "\"Cloth\" is no landscape");
	EXPECT_REFUSED(Renderer->UpdateMeshVertices(Patch, TrianglePositions, nullptr), "is a landscape");
	FRTModuleMeshBuffer Buffer;
	EXPECT_REFUSED(Renderer->GetMeshBuffer(Patch, &Buffer), "is a landscape");
	ASSERT_OK(Renderer->RemoveMesh(Patch));
	EXPECT_REFUSED(Renderer->SetLandscapeHeights(Patch, Edit), "was removed");
}

} // namespace
} // namespace Lantern
