// The parts of FGeometryStore, each by itself on a mock device: entries and frames without the store's order.
#pragma once

#include "Geometry/GeometryBuilder.h"
#include "Geometry/GeometryCompactor.h"
#include "Geometry/GeometryContext.h"
#include "Geometry/GeometryRefits.h"
#include "GeometryStoreTestTools.h"

namespace Lantern
{

/// The store of FGeometryStoreTest stays idle.
class FGeometryContextTest : public FGeometryStoreTest
{
protected:
	void SetUp() override
	{
		FGeometryStoreTest::SetUp();
		Context = std::make_unique<FGeometryContext>(*Device, Addresses);
		Compactor = std::make_unique<FGeometryCompactor>(*Context);
		Refits = std::make_unique<FGeometryRefits>(*Context);
		Builder = std::make_unique<FGeometryBuilder>(*Context, *Compactor, *Refits);
		NextFrame();
	}
	void TearDown() override
	{
		Filler.Reset();
		Builder.reset();
		Refits.reset();
		Compactor.reset();
		Context.reset();
		FGeometryStoreTest::TearDown();
	}
	void NextFrame()
	{
		Context->Memory.BeginFrame(++FrameNumber);
		Context->Stats.Built = Context->Stats.Rebuilt = Context->Stats.Refitted = Context->Stats.Compacted = 0;
		Context->Stats.TrianglesBuilt = 0;
	}
	FRTGeometryRef Add(FRTGeometryInfo Info)
	{
		FRTGeometryRef Geometry = Context->Slots.Create(std::move(Info));
		FGeometryEntry& Entry = Context->Slots[Geometry->GetSlot()];
		Context->Queue.ResetPriority(Geometry->GetSlot());
		Entry.UpdateSizes(*Device);
		return Geometry;
	}
	FRTGeometryRef Add(const std::string& Name, uint32_t Triangles, bool bDynamic = false)
	{
		FRTGeometryInfo Info = MakeInfo(Name, Triangles);
		Info.bDynamic = bDynamic;
		return Add(std::move(Info));
	}
	FGeometryEntry& Entry(const FRTGeometryRef& Geometry) { return Context->Slots[Geometry->GetSlot()]; }
	FGeometrySlots& Slots() { return Context->Slots; }
	uint64_t AddressOf(const FRTGeometryRef& Geometry) const { return Addresses[Geometry->GetSlot()]; }

	/// Records what was chosen, and submits it or loses it.
	FRTStatus RunCommands(bool bSubmit = true)
	{
		TRTRef<IRTCommandList> List;
		FRTStatus Status = Device->CreateCommandList("Frame", List.ReleaseAndGetAddress());
		if (Status) { Status = List->Begin(); }
		if (!Status) { return Status; }
		const uint32_t Parts = Builder->Plan(1);
		Builder->RecordStaging(*List);
		for (uint32_t Part = 0; Part < Parts; ++Part) { Builder->RecordPart(*List, Part); }
		Compactor->RecordCopies(*List);
		Status = Compactor->RecordQueries(*List);
		const FRTStatus Ended = List->End();
		Status = Status ? Ended : Status;
		IRTCommandList* const Lists[] = {List.Get()};
		FRTFence Fence = 0;
		if (Status && bSubmit) { Status = Device->Submit(Lists, 1, &Fence); }
		List.Reset();
		if (bSubmit) { Builder->Submitted(); }
		else { Builder->Lost(); }
		if (bSubmit) { Compactor->Submitted(); }
		else { Compactor->Lost(); }
		Slots().DropHeld();
		return Status;
	}
	/// Adds a geometry and builds it in a frame of its own.
	FRTGeometryRef AddBuilt(const std::string& Name, uint32_t Triangles, bool bDynamic = false)
	{
		FRTGeometryRef Geometry = Add(Name, Triangles, bDynamic);
		EXPECT_TRUE(Builder->AddBuild(Entry(Geometry)));
		EXPECT_TRUE(RunCommands());
		NextFrame();
		return Geometry;
	}
	/// Sets the budget and allocates a structure that leaves Room bytes of it.
	void FillBudget(uint32_t Megabytes, uint64_t Room)
	{
		Set("r.RT.Build.MemoryMB", std::to_string(Megabytes));
		const uint64_t Bytes = (uint64_t(Megabytes) << 20) - GetUsed() - Room;
		FRTGeometrySection Section;
		Section.Vertices = Section.Indices = Shared.Get();
		Section.VertexCount = Section.TriangleCount = 1;
		FRTGeometryDesc Desc;
		Desc.Sections = &Section;
		Desc.SectionCount = 1;
		Desc.CompactedBytes = Bytes; // the mock takes this size as it is
		Desc.Name = "Filler";
		ASSERT_TRUE(Device->CreateGeometry(Desc, Filler.ReleaseAndGetAddress()));
		ASSERT_EQ(Context->Memory.GetRoom(), Room);
	}
	void EmptyBudget() { Filler.Reset(); }

	std::vector<uint64_t> Addresses;
	std::unique_ptr<FGeometryContext> Context;
	std::unique_ptr<FGeometryCompactor> Compactor;
	std::unique_ptr<FGeometryRefits> Refits;
	std::unique_ptr<FGeometryBuilder> Builder;
	TRTRef<IRTGeometry> Filler;
	uint64_t FrameNumber = 0;
};

} // namespace Lantern
