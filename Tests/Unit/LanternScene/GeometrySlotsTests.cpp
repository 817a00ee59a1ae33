// FGeometrySlots: slots, generations, changes. No device.
#include "Geometry/GeometrySlots.h"

#include <thread>

#include <gtest/gtest.h>

namespace Lantern
{
namespace
{

class FGeometrySlotsTest : public ::testing::Test
{
protected:
	FRTGeometryRef Add(bool bDynamic = false, std::shared_ptr<const void> CpuOwner = nullptr)
	{
		FRTGeometryInfo Info;
		Info.Sections = {{0, 3}};
		Info.bDynamic = bDynamic;
		Info.CpuOwner = std::move(CpuOwner);
		return Slots.Create(std::move(Info));
	}
	FGeometrySlotRef MakeRef(const FRTGeometryRef& Geometry) { return Slots.MakeRef(Slots[Geometry->GetSlot()]); }
	uint32_t FreeReleased()
	{
		Coarse = 0;
		return Slots.FreeReleased(Coarse);
	}

	std::vector<uint64_t> Addresses;
	FGeometrySlots Slots{Addresses};
	uint32_t Coarse = 0;
};

TEST_F(FGeometrySlotsTest, GeometriesGetSlotsInOrder)
{
	const FRTGeometryRef A = Add(), B = Add();
	EXPECT_EQ(A->GetSlot(), 0u);
	EXPECT_EQ(B->GetSlot(), 1u);
	EXPECT_EQ(Slots.GetCount(), 2u);
	EXPECT_EQ(Addresses, std::vector<uint64_t>({0, 0}));
	EXPECT_EQ(Slots.GetGeometry(1), B.get());
	EXPECT_EQ(Slots.GetGeometry(2), nullptr) << "there is no such slot";
	EXPECT_LT(Slots[0].Age, Slots[1].Age);
	EXPECT_EQ(Slots.Resolve(MakeRef(B)), &Slots[1]);
}

TEST_F(FGeometrySlotsTest, WhatTheStoreMayReadStaysUntilItTakesItBack)
{
	auto Data = std::make_shared<int>(1);
	const std::weak_ptr<int> Watch = Data;
	FRTGeometryRef A = Add(false, std::move(Data));
	const FRTGeometry* const Geometry = Slots.GetGeometry(0);
	std::thread([&A] { A.reset(); }).join(); // the last owner
	EXPECT_FALSE(Watch.expired());
	EXPECT_EQ(Geometry->GetSlot(), 0u) << "the store may have been about to read it";
	EXPECT_EQ(Slots.GetGeometry(0), nullptr);
	EXPECT_EQ(FreeReleased(), 1u);
	EXPECT_TRUE(Watch.expired());
}

TEST_F(FGeometrySlotsTest, GeometriesMayOutliveTheStore)
{
	auto Data = std::make_shared<int>(1);
	const std::weak_ptr<int> Watch = Data;
	FRTGeometryRef Late, Early;
	{
		FGeometrySlots Others{Addresses};
		FRTGeometryInfo Info;
		Info.Sections = {{0, 3}};
		Early = Others.Create(Info);
		Info.CpuOwner = std::move(Data);
		Late = Others.Create(std::move(Info));
		Early.reset();
	}
	EXPECT_FALSE(Watch.expired());
	Late.reset();
	EXPECT_TRUE(Watch.expired());
}

TEST_F(FGeometrySlotsTest, ReferencesDoNotSurviveTheGeometry)
{
	FRTGeometryRef A = Add();
	const FGeometrySlotRef Ref = MakeRef(A);
	EXPECT_FALSE(Slots.HasReleased());
	A.reset();
	EXPECT_EQ(Slots.Resolve(Ref), nullptr) << "at once, before the slot is free";
	EXPECT_EQ(Slots.GetGeometry(0), nullptr);
	EXPECT_TRUE(Slots.HasReleased());
	EXPECT_EQ(FreeReleased(), 1u);
	EXPECT_FALSE(Slots.HasReleased());
	EXPECT_EQ(FreeReleased(), 0u);
	EXPECT_EQ(Slots[0].State, EGeometryState::Free);
	const FRTGeometryRef B = Add();
	EXPECT_EQ(B->GetSlot(), 0u);
	EXPECT_EQ(Slots.GetCount(), 1u);
	EXPECT_EQ(Slots.Resolve(Ref), nullptr) << "the slot has another geometry";
	EXPECT_NE(Slots.Resolve(MakeRef(B)), nullptr);
}

TEST_F(FGeometrySlotsTest, SlotsAreNotUsedAgainBeforeTheyAreFreed)
{
	FRTGeometryRef A = Add();
	A.reset();
	const FRTGeometryRef B = Add();
	EXPECT_EQ(B->GetSlot(), 1u);
}

TEST_F(FGeometrySlotsTest, NewGeometryInheritsNothing)
{
	FRTGeometryRef A = Add();
	FGeometryEntry& Entry = Slots[0];
	Entry.bLost = Entry.bRefuted = Entry.bCoarse = Entry.bReported = true;
	Entry.ScreenSize = 3.0f;
	Entry.Builds = 4;
	const uint64_t Age = Entry.Age;
	A.reset();
	EXPECT_EQ(FreeReleased(), 1u);
	EXPECT_EQ(Coarse, 1u);
	const FRTGeometryRef B = Add();
	EXPECT_FALSE(Entry.bLost || Entry.bRefuted || Entry.bCoarse || Entry.bReported);
	EXPECT_EQ(Entry.ScreenSize, 0.0f);
	EXPECT_EQ(Entry.Builds, 0u);
	EXPECT_GT(Entry.Age, Age);
}

TEST_F(FGeometrySlotsTest, DynamicGeometriesAreCounted)
{
	FRTGeometryRef A = Add(true), B = Add(false), C = Add(true);
	EXPECT_EQ(Slots.GetDynamicCount(), 2u);
	A.reset();
	B.reset();
	EXPECT_EQ(Slots.GetDynamicCount(), 2u) << "not before the slots are freed";
	EXPECT_EQ(FreeReleased(), 2u);
	EXPECT_EQ(Coarse, 0u);
	EXPECT_EQ(Slots.GetDynamicCount(), 1u);
}

TEST_F(FGeometrySlotsTest, ChangesAreListedOnceInTheirOrder)
{
	const FRTGeometryRef A = Add(), B = Add(), C = Add();
	EXPECT_TRUE(Slots.TakeChanged().empty()) << "a geometry without a structure changes nothing";
	Slots.SetAddress(Slots[2], 20);
	Slots.SetAddress(Slots[0], 10);
	Slots.SetAddress(Slots[2], 21);
	Slots.MarkChanged(Slots[0]);
	EXPECT_EQ(Addresses, std::vector<uint64_t>({10, 0, 21}));
	EXPECT_EQ(Slots.TakeChanged(), std::vector<uint32_t>({2, 0}));
	Slots.SetAddress(Slots[2], 21);
	EXPECT_TRUE(Slots.TakeChanged().empty()) << "the address is what it was";
	Slots.MarkChanged(Slots[1]);
	EXPECT_EQ(Slots.TakeChanged(), std::vector<uint32_t>({1}));
}

TEST_F(FGeometrySlotsTest, FreedAddressIsAChangeThatTheNextGeometryKeeps)
{
	FRTGeometryRef A = Add();
	Slots.SetAddress(Slots[0], 10);
	EXPECT_EQ(Slots.TakeChanged().size(), 1u);
	A.reset();
	EXPECT_EQ(FreeReleased(), 1u);
	EXPECT_EQ(Addresses[0], 0u);
	const FRTGeometryRef B = Add();
	Slots.SetAddress(Slots[0], 30);
	EXPECT_EQ(Slots.TakeChanged(), std::vector<uint32_t>({0})) << "once, though two geometries had the slot";
}

TEST_F(FGeometrySlotsTest, HeldGeometryOutlivesItsOwner)
{
	FRTGeometryRef A = Add();
	const FGeometrySlotRef Ref = MakeRef(A);
	Slots.Hold(Slots[0]);
	A.reset();
	EXPECT_NE(Slots.Resolve(Ref), nullptr);
	EXPECT_FALSE(Slots.HasReleased());
	Slots.DropHeld();
	EXPECT_EQ(Slots.Resolve(Ref), nullptr);
	EXPECT_TRUE(Slots.HasReleased());
}

} // namespace
} // namespace Lantern
