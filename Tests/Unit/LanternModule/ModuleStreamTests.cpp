// Meshes in the engine's own buffers: what the device is told of them, how long they are held, and what is refused.
#include <functional>

#include "ModuleTestTools.h"

namespace Lantern
{
namespace
{

class FModuleStreamTest : public FModuleTest
{
protected:
	static constexpr uint32_t Stride = 40;

	void SetUp() override
	{
		FModuleTest::SetUp();
		SetVariable("r.RT.Build.Compaction", "0"); // a copy does not say what it was built from
	}
	void TearDown() override
	{
		Vertices.Reset();
		Indices.Reset();
		FModuleTest::TearDown();
	}
	TRTRef<IRTBuffer> Import(
	    const char* Name, uint64_t Size, ERTBufferUsage Usage = ERTBufferUsage::GeometryInput | ERTBufferUsage::Storage)
	{
		FRTNativeBuffer Native;
		Native.Handle = ++LastNative;
		Native.Released = [](void* User) { ++*static_cast<int*>(User); };
		Native.User = &Released;
		TRTRef<IRTBuffer> Out;
		const FRTStatus Status = Device->ImportBuffer({Size, Usage, ERTMemory::Device, Name}, Native, Out.ReleaseAndGetAddress());
		EXPECT_TRUE(Status.IsOk()) << Status.Message;
		return Out;
	}
	/// Three vertices from byte 16 on: half positions, byte normals, float texture coordinates.
	FRTModuleMesh Describe()
	{
		if (!Vertices) { Vertices = Import("EngineVertices", 16 + 3 * Stride); }
		if (!Indices) { Indices = Import("EngineIndices", 16); }
		Streams = {};
		Streams.Positions = {Vertices.Get(), 16, Stride, ERTModuleVertex::Half4};
		Streams.Normals = {Vertices.Get(), 24, Stride, ERTModuleVertex::Snorm8x4};
		Streams.UVs = {Vertices.Get(), 28, Stride, ERTModuleVertex::Float2};
		Streams.Indices = Indices.Get();
		Streams.IndicesOffset = 2;
		Streams.bIndices16 = true;
		FRTModuleMesh Mesh;
		Mesh.Name = "Streamed";
		Mesh.VertexCount = 3;
		Mesh.IndexCount = 3;
		Mesh.BoundsRadius = 2.0f;
		Mesh.Streams = &Streams;
		return Mesh;
	}
	/// Renders until all is built, and returns the sections of the one geometry.
	std::vector<FRTGeometrySection> FindBuilt()
	{
		EXPECT_TRUE(WaitUntil(
		    "a complete frame", [&] { return Outputs.bComplete; },
		    [&] {
			ASSERT_OK(RenderWholeFrame());
			GiveWay();
		    }));
		for (IRTScene* const Scene : Mock().FindLiveScenes())
		{
			for (const FRTMockInstance& Instance : Mock().GetSceneInstances(Scene))
			{
				return Mock().GetGeometry(Instance.Geometry).Sections;
			}
		}
		return {};
	}
	uint64_t GetAddress(IRTBuffer* Buffer) const { return Buffer->GetDeviceAddress(); }

	TRTRef<IRTBuffer> Vertices, Indices;
	FRTModuleStreams Streams;
	int Released = 0;
};

/// The compute queue builds from what the engine has just written on its own.
TEST_F(FModuleStreamTest, WorkAheadWaitsForWhatTheEngineHasWritten)
{
	SetVariable("r.RT.Async", "*");
	ASSERT_OK(SetSun(-1.0));
	const auto CountWaits = [&] {
		FRTModuleFrame Frame = DescribeFrame();
		Frame.bSubmitAhead = true;
		Mock().ClearCalls();
		const FRTStatus Status = Renderer->RenderFrame(Frame, &Outputs);
		EXPECT_TRUE(Status.IsOk()) << Status.Message;
		const uint32_t Count = Mock().CountCalls(ERTMockCall::NotifyExternalSubmit);
		EXPECT_TRUE(Renderer->EndFrame(nullptr).IsOk());
		return Count;
	};
	EXPECT_EQ(CountWaits(), 0u);
	ASSERT_OK(AddObject(AddMesh(Describe()), Solid));
	EXPECT_EQ(CountWaits(), 1u);
	EXPECT_EQ(CountWaits(), 0u);
}

TEST_F(FModuleStreamTest, TheDeviceReadsTheEnginesBuffers)
{
	ASSERT_OK(AddObject(AddMesh(Describe()), Solid));
	ASSERT_OK(SetSun(-1.0));
	const std::vector<FRTGeometrySection> Built = FindBuilt();
	const FSceneConstants Scene = ReadConstants(DescribeFrame());
	ASSERT_EQ(Built.size(), 1u);
	EXPECT_EQ(Built[0].VertexFormat, ERTVertexFormat::Half4);
	EXPECT_EQ(Built[0].VertexStride, Stride);
	EXPECT_EQ(Built[0].VertexOffset, 16u);
	EXPECT_EQ(Built[0].IndexOffset, 2u);
	EXPECT_EQ(Built[0].IndexType, ERTIndexType::UInt16);
	EXPECT_EQ(Built[0].Vertices->GetDeviceAddress(), GetAddress(Vertices.Get()));
	const auto Section = ReadEntry<FSectionData>(Scene.Sections, 0);
	EXPECT_EQ(Section.Flags, SECTION_STREAMS | SECTION_INDEX_16 | SECTION_INDEX_ODD | SECTION_PLAIN_OPACITY);
	EXPECT_EQ(Section.Indices, GetAddress(Indices.Get()));
	const auto Read = ReadEntry<FVertexStreams>(Section.Attributes, 0);
	EXPECT_EQ(Read.Positions.Address, GetAddress(Vertices.Get()) + 16);
	EXPECT_EQ(Read.Normals.Address, GetAddress(Vertices.Get()) + 24);
	EXPECT_EQ(Read.UV0.Address, GetAddress(Vertices.Get()) + 28);
	EXPECT_EQ(Read.UV0.Format, VERTEX_FLOAT2);
	for (const FVertexStream& Stream : {Read.Positions, Read.Normals, Read.UV0}) { EXPECT_EQ(Stream.Stride, Stride); }
	for (const FVertexStream& Stream : {Read.Tangents, Read.UV1, Read.Colors}) { EXPECT_EQ(Stream.Address, 0u); }
	EXPECT_EQ(CountCopies("EngineVertices") + CountCopies("EngineIndices"), 0u);
	const std::vector<IRTBuffer*> Own = Mock().FindLiveBuffers("Streamed");
	ASSERT_EQ(Own.size(), 1u);
	EXPECT_EQ(Own[0]->GetDesc().Size, sizeof(FVertexStreams)) << "nothing is copied but where it lies";
}

TEST_F(FModuleStreamTest, SectionsMayBeginAtAnyVertex)
{
	FRTModuleMesh Mesh = Describe();
	Vertices = Import("EngineVertices", 16 + 4 * Stride);
	for (FRTModuleStream* const Stream : {&Streams.Positions, &Streams.Normals, &Streams.UVs}) { Stream->Buffer = Vertices.Get(); }
	const FRTModuleSection Sections[] = {{0, 3, false, 0}, {3, 3, false, 1}};
	Mesh.VertexCount = 4;
	Mesh.IndexCount = 6;
	Mesh.Sections = Sections;
	Mesh.SectionCount = 2;
	const ERTMaterialHandle Materials[] = {Solid, Solid};
	FRTModuleObject Desc;
	Desc.Mesh = AddMesh(Mesh);
	Desc.Materials = Materials;
	Desc.MaterialCount = 2;
	ASSERT_OK(Renderer->AddObject(Desc, &Object));
	ASSERT_OK(SetSun(-1.0));
	const std::vector<FRTGeometrySection> Built = FindBuilt();
	const FSceneConstants Scene = ReadConstants(DescribeFrame());
	ASSERT_EQ(Built.size(), 2u);
	EXPECT_EQ(Built[1].VertexOffset, 16u + Stride);
	EXPECT_EQ(Built[1].VertexCount, 3u);
	const auto Read = ReadEntry<FVertexStreams>(ReadEntry<FSectionData>(Scene.Sections, 1).Attributes, 0);
	EXPECT_EQ(Read.Normals.Address, GetAddress(Vertices.Get()) + 24 + Stride);
}

TEST_F(FModuleStreamTest, MemoryIsHeldUntilTheDeviceIsDoneWithIt)
{
	const ERTMeshHandle Mesh = AddMesh(Describe());
	ASSERT_OK(AddObject(Mesh, Solid));
	ASSERT_OK(SetSun(-1.0));
	Vertices.Reset();
	Indices.Reset();
	for (int Frame = 0; Frame < 6; ++Frame) { ASSERT_OK(RenderWholeFrame()); }
	Device->CollectGarbage();
	EXPECT_EQ(Released, 0) << "the mesh is there";
	ASSERT_OK(Renderer->RemoveObject(Object));
	ASSERT_OK(Renderer->RemoveMesh(Mesh));
	EXPECT_TRUE(WaitUntil(
	    "both buffers are released", [&] { return Released == 2; },
	    [&] {
		ASSERT_OK(RenderWholeFrame());
		Device->CollectGarbage();
		GiveWay();
	    }));
	for (int Frame = 0; Frame < 4; ++Frame) { ASSERT_OK(RenderWholeFrame()); }
	EXPECT_EQ(Released, 2) << "each once";
}

TEST_F(FModuleStreamTest, TheEnginesGpuMayDeformThem)
{
	FRTModuleMesh Desc = Describe();
	Desc.bDeformable = true;
	const ERTMeshHandle Mesh = AddMesh(Desc);
	ASSERT_OK(AddObject(Mesh, Solid));
	ASSERT_OK(SetSun(-1.0));
	EXPECT_EQ(FindBuilt().size(), 1u);
	FRTModuleMeshBuffer Buffer;
	EXPECT_REFUSED(Renderer->GetMeshBuffer(Mesh, &Buffer), "the engine's own buffers");
	EXPECT_REFUSED(Renderer->UpdateMeshVertices(Mesh, TrianglePositions, nullptr), "the engine's own buffers");
	Mock().ClearCalls();
	ASSERT_OK(RenderWholeFrame());
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::BuildGeometry), 0u);
	ASSERT_OK(Renderer->MarkMeshDeformed(Mesh));
	ASSERT_OK(RenderWholeFrame());
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::BuildGeometry), 1u) << "a refit from the engine's buffer";
	EXPECT_EQ(CountCopies("EngineVertices"), 0u);
}

TEST_F(FModuleStreamTest, WhatCannotBeIsNamed)
{
	ERTMeshHandle Out = ERTMeshHandle::None;
	const auto Expect = [&](const char* Part, const std::function<void(FRTModuleMesh&)>& Change) {
		FRTModuleMesh Mesh = Describe();
		Change(Mesh);
		EXPECT_REFUSED(Renderer->AddMesh(Mesh, &Out), Part);
		EXPECT_EQ(Out, ERTMeshHandle::None);
	};
	const TRTRef<IRTBuffer> NoBuilds = Import("NoBuilds", 256, ERTBufferUsage::Storage);
	Expect("Positions.Buffer is null", [&](auto&) { Streams.Positions.Buffer = nullptr; });
	Expect("Positions.Buffer lacks a usage", [&](auto&) { Streams.Positions.Buffer = NoBuilds.Get(); });
	Expect("Positions.Format", [&](auto&) { Streams.Positions.Format = ERTModuleVertex::Float2; });
	Expect("Positions.Stride", [&](auto&) { Streams.Positions.Stride = 4; });
	Expect("Normals.Stride", [&](auto&) { Streams.Normals.Stride = 6; });
	Expect("UVs.Offset is no multiple", [&](auto&) { Streams.UVs.Offset = 2; });
	Expect("UVs.Offset: the vertices reach past", [&](auto&) { Streams.UVs.Offset = 56; });
	Expect("Normals.Offset: the vertices reach past", [&](auto&) { Streams.Normals.Offset = ~3ull; });
	Expect("Colors.Format", [&](auto&) { Streams.Colors = {Vertices.Get(), 0, Stride, ERTModuleVertex::Float3}; });
	Expect("Indices is null", [&](auto&) { Streams.Indices = nullptr; });
	Expect("IndicesOffset", [&](auto&) { Streams.IndicesOffset = 1; });
	Expect("Indices: IndexCount", [&](auto&) { Streams.IndicesOffset = 12; });
	Expect("bSignInNormals", [&](auto&) { Streams.bSignInNormals = true, Streams.Normals.Buffer = nullptr; });
	Expect("BoundsRadius", [](FRTModuleMesh& Mesh) { Mesh.BoundsRadius = -1.0f; });
	Expect("beside Streams", [](FRTModuleMesh& Mesh) { Mesh.Positions = TrianglePositions; });
	const FRTModuleSection Behind{0, 3, true, 3};
	Expect("FirstVertex", [&](FRTModuleMesh& Mesh) { Mesh.Sections = &Behind, Mesh.SectionCount = 1; });
}

} // namespace
} // namespace Lantern
