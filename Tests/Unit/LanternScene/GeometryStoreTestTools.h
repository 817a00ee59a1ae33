// A geometry store on a mock device, without a scene.
#pragma once

#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternRHIMock/MockDevice.h"
#include "LanternScene/Geometry/GeometryStore.h"

namespace Lantern
{

class FGeometryStoreTest : public ::testing::Test
{
protected:
	void SetUp() override
	{
		FConsoleVariables::Get().ResetAll();
		Set("r.RT.Build.TrianglesPerFrame", "0");
		Open({});
	}
	void TearDown() override
	{
		if (Device) { EXPECT_EQ(Mock().GetErrors(), std::vector<std::string>()); }
		Store.reset();
		Tlas.Reset();
		FConsoleVariables::Get().ResetAll();
		FConsoleVariables::Get().BeginFrame();
	}
	void Open(const FRTMockDesc& Desc)
	{
		Store.reset();
		ASSERT_TRUE(CreateMockDevice(Desc, Device.ReleaseAndGetAddress()));
		Store = std::make_unique<FGeometryStore>(*Device);
	}
	static void Set(const char* Name, const std::string& Value)
	{
		EXPECT_EQ(FConsoleVariables::Get().Set(Name, Value, ERTSetBy::Console, "test"), std::nullopt);
		FConsoleVariables::Get().BeginFrame();
	}
	FRTMock& Mock() { return GetMock(Device.Get()); }

	TRTRef<IRTBuffer> MakeBuffer(const std::string& Name, uint64_t Size)
	{
		TRTRef<IRTBuffer> Buffer;
		const ERTBufferUsage Usage = ERTBufferUsage::Storage | ERTBufferUsage::GeometryInput;
		EXPECT_TRUE(Device->CreateBuffer({Size, Usage, ERTMemory::Device, Name.c_str()}, Buffer.ReleaseAndGetAddress()));
		return Buffer;
	}
	/// Sections of Triangles each, in one set of small buffers: the mock reads none of them.
	FRTGeometryInfo MakeInfo(const std::string& Name, uint32_t Triangles, uint32_t Sections = 1)
	{
		if (!Shared) { Shared = MakeBuffer("Shared", 4096); }
		FRTGeometryInfo Info;
		Info.Name = Name;
		Info.Positions = Info.Attributes = Info.Indices = Shared;
		Info.VertexCount = 3 * Triangles;
		for (uint32_t Section = 0; Section < Sections; ++Section)
		{
			Info.Sections.push_back({3 * Section * Triangles, 3 * Triangles, true});
		}
		return Info;
	}
	FRTGeometryRef Make(const std::string& Name, uint32_t Triangles, bool bDynamic = false)
	{
		FRTGeometryInfo Info = MakeInfo(Name, Triangles);
		Info.bDynamic = bDynamic;
		FRTGeometryRef Out;
		const FRTStatus Status = Store->Create(std::move(Info), Out);
		EXPECT_TRUE(Status) << Status.Message;
		return Out;
	}
	/// A bumpy square of Cells² · 2 triangles that lives as long as the test, in two sections of rows.
	FRTGeometryInfo MakeTerrain(const std::string& Name, uint32_t Cells)
	{
		std::vector<glm::vec3>& Positions = CpuPositions.emplace_back();
		std::vector<uint32_t>& Indices = CpuIndices.emplace_back();
		for (uint32_t Y = 0; Y <= Cells; ++Y)
		{
			for (uint32_t X = 0; X <= Cells; ++X) { Positions.emplace_back(X, std::sin(0.3f * X) * std::cos(0.2f * Y), Y); }
		}
		for (uint32_t Y = 0; Y < Cells; ++Y)
		{
			for (uint32_t X = 0; X < Cells; ++X)
			{
				const uint32_t A = Y * (Cells + 1) + X, B = A + 1, C = A + Cells + 1, D = C + 1;
				Indices.insert(Indices.end(), {A, C, B, B, C, D});
			}
		}
		FRTGeometryInfo Info = MakeInfo(Name, 1);
		const uint32_t Half = Cells / 2 * Cells * 6, Rest = static_cast<uint32_t>(Indices.size()) - Half;
		Info.Sections = {{0, Half, true}, {Half, Rest, false}};
		Info.VertexCount = static_cast<uint32_t>(Positions.size());
		Info.CpuPositions = Positions.data();
		Info.CpuIndices = Indices.data();
		return Info;
	}

	/// What a scene does: all that have an address are instances of a TLAS, which the mock checks.
	FRTStatus Frame(bool bBuildAll = false, bool bSubmit = true)
	{
		FRTStatus Status = Store->BeginFrame(bBuildAll);
		CheckPeak();
		if (!Status)
		{
			Store->EndFrame(false);
			return Status;
		}
		TRTRef<IRTCommandList> List;
		Status = Device->CreateCommandList("Frame", List.ReleaseAndGetAddress());
		if (Status) { Status = List->Begin(); }
		if (Status) { Status = Store->Record(*List); }
		if (Status) { Status = BuildScene(*List); }
		if (Status) { Status = List->End(); }
		if (Status && bSubmit)
		{
			FRTFence Fence = 0;
			IRTCommandList* const Lists[] = {List.Get()};
			Status = Device->Submit(Lists, 1, &Fence);
		}
		List.Reset();
		CheckPeak();
		Store->EndFrame(Status && bSubmit);
		CheckPeak();
		return Status;
	}
	void Frames(uint32_t Count)
	{
		for (uint32_t I = 0; I < Count; ++I)
		{
			const FRTStatus Status = Frame();
			ASSERT_TRUE(Status) << Status.Message;
		}
	}
	uint64_t GetAddress(const FRTGeometryRef& Geometry) const { return Store->GetAddress(Geometry->GetSlot()); }
	const FGeometryStoreStats& Stats() const { return Store->GetStats(); }
	uint64_t GetUsed()
	{
		const FRTMemoryStats Memory = Device->GetMemoryStats();
		return Memory.Geometry + Memory.Scene + Memory.Scratch;
	}

	TRTRef<IRTDevice> Device;
	TRTRef<IRTBuffer> Shared;
	std::unique_ptr<FGeometryStore> Store;
	std::deque<std::vector<glm::vec3>> CpuPositions;
	std::deque<std::vector<uint32_t>> CpuIndices;
	uint64_t MostUsed = 0;
	bool bInstances = true; ///< a TLAS in each frame

private:
	void CheckPeak() { MostUsed = std::max(MostUsed, GetUsed()); }
	FRTStatus BuildScene(IRTCommandList& List)
	{
		if (!bInstances) { return FRTStatus::Success(); }
		constexpr uint32_t Most = 1024;
		if (!Tlas)
		{
			FRTSceneDesc Desc;
			Desc.MaxInstances = Most;
			Desc.Name = "Scene";
			if (FRTStatus S = Device->CreateScene(Desc, Tlas.ReleaseAndGetAddress()); !S) { return S; }
		}
		TRTRef<IRTBuffer> Instances;
		const FRTBufferDesc Desc{Most * sizeof(FRTInstance), ERTBufferUsage::GeometryInput, ERTMemory::Upload, "Instances"};
		if (FRTStatus S = Device->CreateBuffer(Desc, Instances.ReleaseAndGetAddress()); !S) { return S; }
		auto* const Data = static_cast<FRTInstance*>(Instances->GetMapped());
		uint32_t Count = 0;
		for (uint32_t Slot = 0; Slot < Store->GetSlotCount() && Count < Most; ++Slot)
		{
			const uint64_t Address = Store->GetAddress(Slot);
			if (Address == 0) { continue; }
			Data[Count] = {};
			Data[Count++].GeometryAddress = Address;
		}
		// The mock keeps its scratch to itself.
		List.BuildScene(Tlas.Get(), Instances.Get(), 0, Count, nullptr, 0);
		return FRTStatus::Success();
	}
	TRTRef<IRTScene> Tlas;
};

} // namespace Lantern
