// One pipeline with every stage, its groups given by name, so that it can be made in one piece or of libraries.
#pragma once

#include "RayFixture.h"

#include <algorithm>
#include <cstring>

namespace Lantern
{

/// Shaders named "Salt…" and Slab.rint answer with push constant G, so that a stage without the constants is seen.
inline const FRayGroup StageTrace = {"Trace.rgen"}, StageCall = {"Call.rgen"}, StageMiss = {"SaltMiss.rmiss"}, StageSalt = {"Salt.rcall"},
                       StageHit = {nullptr, "SaltHit.rchit"}, StageParity = {nullptr, "SaltHit.rchit", "Parity.rahit"},
                       StageAnyOnly = {nullptr, nullptr, "Parity.rahit"}, StageBox = {nullptr, "BoxHit.rchit", nullptr, "Slab.rint"},
                       StageBoxParity = {nullptr, "BoxHit.rchit", "Parity.rahit", "Slab.rint"}, StageCalls = {nullptr, "HitCalls.rchit"};

inline bool operator==(const FRayGroup& A, const FRayGroup& B)
{
	// By text: each file that is compiled may have its own copy of a name, and has it under the address sanitizer.
	const auto IsSame = [](const char* X, const char* Y) { return X && Y ? std::strcmp(X, Y) == 0 : X == Y; };
	return IsSame(A.General, B.General) && IsSame(A.ClosestHit, B.ClosestHit) && IsSame(A.AnyHit, B.AnyHit) &&
	       IsSame(A.Intersection, B.Intersection);
}

class FRayStageFixture : public FRayContract
{
protected:
	static constexpr uint32_t HitRecords = 6;
	using FGroups = std::vector<FRayGroup>;

	static FGroups GetGeneralGroups() { return {StageTrace, StageCall, StageMiss, StageSalt}; }
	static FGroups GetHitGroups() { return {StageHit, StageParity, StageAnyOnly, StageBox, StageBoxParity, StageCalls}; }
	void TearDown() override
	{
		Squares = Masked = {};
		Boxes = OpenBoxes = {};
		FRayContract::TearDown();
	}
	/// Order: names of the groups of InPipeline, in their order.
	void Use(TRTRef<IRTPipeline> InPipeline, const FGroups& Order)
	{
		Pipeline = std::move(InPipeline);
		ASSERT_TRUE(Pipeline);
		ASSERT_EQ(Pipeline->GetGroupCount(), Order.size());
		Groups = Order;
	}
	uint32_t Find(const FRayGroup& Group) const
	{
		const auto Found = std::find(Groups.begin(), Groups.end(), Group);
		EXPECT_NE(Found, Groups.end());
		return static_cast<uint32_t>(Found - Groups.begin());
	}
	void CreateStageTable()
	{
		FRTShaderTableDesc Desc;
		Desc.Pipeline = Pipeline.Get();
		Desc.RayGenCount = 2;
		Desc.MissCount = Desc.CallableCount = 1;
		Desc.HitCount = HitRecords;
		Desc.RecordDataBytes = 4;
		Desc.Name = "StageTable";
		ASSERT_OK(Device().CreateShaderTable(Desc, Table.ReleaseAndGetAddress()));
	}
	/// Sets hit record i to group i of GetHitGroups with value 10 + i, and ray generation records to trace and call.
	void MakeStageTable()
	{
		ASSERT_NO_FATAL_FAILURE(CreateStageTable());
		SetStageRecords();
	}
	void SetStageRecords()
	{
		Table->SetRecord(ERTRecordKind::RayGen, 0, Find(StageTrace), nullptr, 0);
		Table->SetRecord(ERTRecordKind::RayGen, 1, Find(StageCall), nullptr, 0);
		Table->SetRecord(ERTRecordKind::Miss, 0, Find(StageMiss), nullptr, 0);
		Table->SetRecord(ERTRecordKind::Callable, 0, Find(StageSalt), nullptr, 0);
		const FGroups Hits = GetHitGroups();
		for (uint32_t Index = 0; Index < HitRecords; ++Index) { SetHit(Index, 10 + Index, Find(Hits[Index])); }
	}
	/// Pixels 0, 1 and 2 see opaque squares with records 0, 1 and 5. Pixels 3 and 4 see masked squares with records 1 and 2.
	/// Pixels 5 and 6 see two boxes with record 3. Pixels 7 and 8 see two masked boxes with record 4. Pixel 9 sees nothing.
	void MakeStageScene()
	{
		Squares = MakeSquares();
		Masked = MakeSquares(1, false);
		Boxes = MakeBoxes({0, 0, -0.5f, 1, 1, 0.25f, 1, 0, -0.5f, 2, 1, 0.25f});
		OpenBoxes = MakeBoxes({0, 0, -0.5f, 1, 1, 0.25f, 1, 0, -0.5f, 2, 1, 0.25f}, false);
		FRTInstance Box = Place(Boxes, 5, 7, 3), OneBox = Place(OpenBoxes, 7, 9, 4);
		Load({&Squares, &Masked, &Boxes, &OpenBoxes}, {Place(Squares, 0, 1, 0), Place(Squares, 1, 2, 1), Place(Squares, 2, 3, 5),
		                                                  Place(Masked, 3, 4, 1), Place(Masked, 4, 5, 2), Box, OneBox});
	}
	FContractPush MakeStagePush(uint32_t Salt, uint32_t RayFlags = 0) const
	{
		FContractPush Push = MakePush(RayFlags);
		Push.Input = Boxes.Vertices->GetDeviceAddress();
		Push.G = Salt;
		return Push;
	}
	/// Computes by hand what the pixels of MakeStageScene must answer.
	static FWords GetExpected(uint32_t Salt)
	{
		const auto Plain = [&](uint32_t Record, uint32_t Custom) { return (10 + Record) << 16 | Salt << 8 | Custom; };
		const auto Box = [&](uint32_t Record, uint32_t Primitive) { return (10 + Record) << 16 | (Salt + Primitive) << 8 | 5; };
		const uint32_t Miss = 0xe0000000u | Salt;
		// Masked: the square is of two triangles; the ray meets the first, and Parity looks at record + primitive + salt.
		const bool bOdd = Salt % 2 != 0;
		return {Plain(0, 1), Plain(1, 2), 15 + Salt, bOdd ? Plain(1, 4) : Miss, bOdd ? Miss : 0, Box(3, 0), Box(3, 1),
		    bOdd ? Miss : Box(4, 0), bOdd ? Box(4, 1) : Miss, Miss};
	}
	/// Two salts, so that neither an answer from before nor a constant passes.
	void ExpectAllStages(const char* What)
	{
		for (const uint32_t Salt : {2u, 5u})
		{
			EXPECT_EQ(Trace(10, MakeStagePush(Salt)), GetExpected(Salt)) << What << ", salt " << Salt;
			FContractPush Push = MakeStagePush(Salt);
			EXPECT_EQ(Trace(3, Push, 1), (FWords{Salt, Salt + 1, Salt + 2})) << What << ", callable";
		}
	}

	FGroups Groups;
	FContractGeometry Squares, Masked, Boxes, OpenBoxes;
};

} // namespace Lantern
