// For the tests of LanternScene: a mock device, a scene on it, geometry without pictures, and frames.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "LanternRHIMock/MockDevice.h"
#include "LanternScene/Pipelines/RTPSO.h"
#include "LanternScene/Scene/Scene.h"
#include "LanternScene/ShaderTable/SectionTable.h"
#include "LanternScene/ShaderTable/ShaderTable.h"

namespace Lantern
{

inline TRTRef<IRTDevice> MakeMockDevice(const FRTMockDesc& Desc = {})
{
	TRTRef<IRTDevice> Device;
	const FRTStatus Status = CreateMockDevice(Desc, Device.ReleaseAndGetAddress());
	EXPECT_TRUE(Status) << Status.Message;
	return Device;
}

inline FMaterialData MakeMaterial(uint32_t Flags = 0, float EmissiveWeight = 0.0f)
{
	FMaterialData Data{};
	Data.Flags = Flags;
	Data.EmissiveWeight = EmissiveWeight;
	return Data;
}

struct FGeometryOptions
{
	bool bDynamic = false;
	bool bOpaque = true;
	bool bTangents = false;
	bool bCpuData = false; ///< coarser levels and clusters of flat emissive parts need it
	bool bOpaqueVertices = false;
	bool bStreams = false; ///< of a host's own vertices
	ERTIndexType IndexType = ERTIndexType::UInt32;
	uint32_t TrianglesPerSection = 1;
};

/// Null members: the frame keeps no hit records.
struct FTracing
{
	FShaderTable* Bindings = nullptr;
	const FRTPSO* Pipeline = nullptr;
};

class FSceneTest : public ::testing::Test
{
protected:
	void SetUp() override { Open({}); }
	void TearDown() override
	{
		if (Device) { EXPECT_EQ(Mock().GetErrors(), std::vector<std::string>()); }
	}
	void Open(const FRTMockDesc& Desc)
	{
		Scene.reset();
		Uploads.reset();
		Device = MakeMockDevice(Desc);
		Uploads = std::make_unique<FFrameUploads>(*Device);
		Scene = std::make_unique<FRTScene>(*Device);
	}
	FRTMock& Mock() { return GetMock(Device.Get()); }

	TRTRef<IRTBuffer> MakeBuffer(const std::string& Name, uint64_t Size)
	{
		TRTRef<IRTBuffer> Buffer;
		const FRTBufferDesc Desc{Size, ERTBufferUsage::Storage | ERTBufferUsage::GeometryInput, ERTMemory::Device, Name.c_str()};
		const FRTStatus Status = Device->CreateBuffer(Desc, Buffer.ReleaseAndGetAddress());
		EXPECT_TRUE(Status) << Status.Message;
		return Buffer;
	}
	/// Triangle i has the corners (i, 0, 0), (i + 1, 0, 0), (i, 1, 0): area 1/2.
	FRTGeometryInfo MakeInfo(const std::string& Name, uint32_t SectionCount, const FGeometryOptions& Options = {})
	{
		const uint32_t Triangles = SectionCount * Options.TrianglesPerSection;
		FRTGeometryInfo Info;
		Info.Name = Name;
		Info.Positions = MakeBuffer(Name, Triangles * 36 + 64);
		Info.PositionsOffset = 64;
		Info.Attributes = MakeBuffer(Name, Triangles * 3 * sizeof(FVertexAttributes));
		Info.Indices = MakeBuffer(Name, Triangles * 12 + 32);
		Info.IndicesOffset = 32;
		Info.IndexType = Options.IndexType;
		Info.VertexCount = 3 * Triangles;
		Info.bHasTangents = Options.bTangents;
		Info.bDynamic = Options.bDynamic;
		Info.bOpaqueVertices = Options.bOpaqueVertices;
		Info.bStreams = Options.bStreams;
		for (uint32_t Section = 0; Section < SectionCount; ++Section)
		{
			Info.Sections.push_back({3 * Section * Options.TrianglesPerSection, 3 * Options.TrianglesPerSection, Options.bOpaque});
		}
		if (Options.bCpuData)
		{
			std::vector<glm::vec3>& Positions = CpuPositions.emplace_back();
			std::vector<uint32_t>& Indices = CpuIndices.emplace_back();
			for (uint32_t I = 0; I < Triangles; ++I)
			{
				for (const glm::vec3 Corner : {glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)})
				{
					Indices.push_back(static_cast<uint32_t>(Positions.size()));
					Positions.push_back(Corner + glm::vec3(I, 0, 0));
				}
			}
			Info.CpuPositions = Positions.data();
			Info.CpuIndices = Indices.data();
		}
		return Info;
	}
	FRTGeometryRef MakeGeometry(const std::string& Name, uint32_t SectionCount, const FGeometryOptions& Options = {})
	{
		FRTGeometryRef Geometry;
		const FRTStatus Status = Scene->CreateGeometry(MakeInfo(Name, SectionCount, Options), Geometry);
		EXPECT_TRUE(Status) << Status.Message;
		return Geometry;
	}
	FRTObjectId Add(const FRTGeometryRef& Geometry, std::vector<uint32_t> Materials, glm::dvec3 Position = {})
	{
		FRTObjectInfo Info;
		Info.Geometry = Geometry;
		Info.Materials = std::move(Materials);
		Info.Transform[3] = glm::dvec4(Position, 1.0);
		return Scene->AddObject(std::move(Info));
	}

	/// One frame: update, records, submission.
	FRTFence Frame(glm::dvec3 Camera = {}, const FSceneUse& Use = {}, const FTracing& Tracing = {})
	{
		TRTRef<IRTCommandList> List;
		EXPECT_TRUE(Device->CreateCommandList("Frame", List.ReleaseAndGetAddress()));
		EXPECT_TRUE(List->Begin());
		Scene->RefreshFacts();
		bUpdated = Scene->NeedsUpdate(Camera, Use);
		if (bUpdated) { EXPECT_TRUE(Scene->Update(*List, *Uploads, Camera, Use)); }
		if (Tracing.Bindings) { EXPECT_TRUE(Tracing.Bindings->Sync(*List, *Tracing.Pipeline, Scene->GetSections())); }
		EXPECT_TRUE(List->End());
		EmissiveWork = Scene->GetEmissiveWork().Count;
		FRTFence Fence = 0;
		IRTCommandList* const Lists[] = {List.Get()};
		EXPECT_TRUE(Device->Submit(Lists, 1, &Fence));
		Uploads->EndFrame(Fence);
		Scene->EndFrame(true, Fence);
		return Fence;
	}
	/// Frames until nothing is left to do: builds, their compaction, what follows from it; scratch that was large goes
	/// after 64 still frames.
	void Settle(glm::dvec3 Camera = {}, const FSceneUse& Use = {})
	{
		for (int I = 0; I < 80; ++I)
		{
			Frame(Camera, Use);
			if (!bUpdated) { return; }
		}
		ADD_FAILURE() << "the scene does not come to rest";
	}
	std::vector<FRTMockInstance> GetInstances() { return Mock().GetSceneInstances(Scene->GetStructure()); }
	template <class T>
	T Read(FAddress Address, uint32_t Index)
	{
		T Value{};
		uint64_t Offset = 0;
		IRTBuffer* const Buffer = Mock().FindBuffer(Address + Index * sizeof(T), &Offset);
		EXPECT_TRUE(Buffer) << "no buffer holds entry " << Index;
		if (Buffer) { std::memcpy(&Value, Mock().GetBytes(Buffer) + Offset, sizeof(T)); }
		return Value;
	}

	TRTRef<IRTDevice> Device;
	std::unique_ptr<FFrameUploads> Uploads;
	std::unique_ptr<FRTScene> Scene;
	bool bUpdated = false;     ///< by the last Frame
	uint32_t EmissiveWork = 0; ///< clusters of emissive triangles that the last Frame had to find
	std::deque<std::vector<glm::vec3>> CpuPositions;
	std::deque<std::vector<uint32_t>> CpuIndices;
};

} // namespace Lantern
