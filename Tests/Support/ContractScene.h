// Geometries, scenes and shader tables of the corpus' ray tests: unit squares in the plane z = 0, one per pixel.
#pragma once

#include "Contract/ContractShaders.h"

namespace Lantern
{

/// VK_GEOMETRY_INSTANCE_TRIANGLE_FLIP_FACING_BIT_KHR. Without it the front is clockwise in a left-handed space, that is
/// counter-clockwise in our right-handed one, as glTF has it.
inline constexpr uint32_t FlipFacing = 2;

/// A geometry with the buffers that its sections point at.
struct FContractGeometry
{
	TRTRef<IRTBuffer> Vertices, Indices;
	std::vector<FRTGeometrySection> Sections;
	TRTRef<IRTGeometry> Geometry;

	uint64_t GetAddress() const { return Geometry->GetDeviceAddress(); }
};

/// What the tests of builds and rays share. SetUp leaves the test skipped where the device cannot trace.
template <class TBase>
class TSceneFixture : public TBase
{
protected:
	void SetUp() override
	{
		TBase::SetUp();
		if (this->HasFatalFailure()) { return; }
		if (this->Caps().Rung == ERTRung::None) { GTEST_SKIP() << "the device has no ray tracing"; }
		Scratch = this->Make.Scratch(4 << 20);
	}
	void TearDown() override
	{
		Scratch.Reset();
		TBase::TearDown();
	}
	/// Count unit squares side by side from x = 0, each a section of two triangles, counter-clockwise seen from +z.
	FContractGeometry MakeSquares(uint32_t Count = 1, bool bOpaque = true, bool bUpdate = false, const char* Name = "Squares")
	{
		FContractGeometry Out;
		std::vector<float> Vertices;
		for (uint32_t i = 0; i < Count; ++i)
		{
			const float X = static_cast<float>(i);
			Vertices.insert(Vertices.end(), {X, 0, 0, X + 1, 0, 0, X + 1, 1, 0, X, 1, 0});
		}
		const uint16_t Indices[] = {0, 1, 2, 0, 2, 3};
		Out.Vertices = this->Upload(Vertices, "Vertices");
		Out.Indices = this->Upload(Indices, sizeof(Indices), "Indices");
		for (uint32_t i = 0; i < Count; ++i)
		{
			FRTGeometrySection& Section = Out.Sections.emplace_back();
			Section.Vertices = Out.Vertices.Get();
			Section.VertexOffset = i * 48;
			Section.VertexCount = 4;
			Section.Indices = Out.Indices.Get();
			Section.TriangleCount = 2;
			Section.IndexType = ERTIndexType::UInt16;
			Section.bOpaque = bOpaque;
		}
		Create(Out, bUpdate, Name);
		return Out;
	}
	/// Boxes: six floats each.
	FContractGeometry MakeBoxes(const std::vector<float>& Boxes, bool bOpaque = true)
	{
		FContractGeometry Out;
		Out.Vertices = this->Upload(Boxes, "Boxes");
		FRTGeometrySection& Section = Out.Sections.emplace_back();
		Section.Vertices = Out.Vertices.Get();
		Section.VertexStride = 24;
		Section.VertexCount = static_cast<uint32_t>(Boxes.size() / 6);
		Section.bProcedural = true;
		Section.bOpaque = bOpaque;
		Create(Out, false, "Boxes");
		return Out;
	}
	void Create(FContractGeometry& Out, bool bUpdate, const char* Name)
	{
		FRTGeometryDesc Desc;
		Desc.Sections = Out.Sections.data();
		Desc.SectionCount = static_cast<uint32_t>(Out.Sections.size());
		Desc.bAllowUpdate = bUpdate;
		Desc.Name = Name;
		EXPECT_OK(this->Device().CreateGeometry(Desc, Out.Geometry.ReleaseAndGetAddress()));
	}
	/// With the barrier behind it.
	void Build(IRTCommandList* List, const FContractGeometry& Item, bool bUpdate = false)
	{
		FRTGeometryBuild Desc;
		Desc.Geometry = Item.Geometry.Get();
		Desc.Sections = Item.Sections.data();
		Desc.SectionCount = static_cast<uint32_t>(Item.Sections.size());
		Desc.bUpdate = bUpdate;
		Desc.Scratch = Scratch.Get();
		List->BuildGeometries(&Desc, 1);
		this->Make.BuildBarrier(List);
	}
	/// Builds the scene from these, with the barrier behind it. The instances are kept by the list.
	void BuildScene(IRTCommandList* List, IRTScene* Scene, const std::vector<FRTInstance>& Instances)
	{
		const auto Buffer = Instances.empty() ? TRTRef<IRTBuffer>() : this->Upload(Instances, "Instances");
		List->BuildScene(Scene, Buffer.Get(), 0, static_cast<uint32_t>(Instances.size()), Scratch.Get(), 0);
		this->Make.BuildBarrier(List);
	}
	/// Instance of Item moved to x, with the custom index.
	static FRTInstance Place(const FContractGeometry& Item, float X, uint32_t Custom = 0, uint32_t TableOffset = 0, uint32_t Mask = 0xff)
	{
		FRTInstance Out = FRHIMaker::Instance(Item.GetAddress(), TableOffset);
		Out.Transform[3] = X;
		Out.CustomIndexAndMask = Custom | (Mask << 24);
		return Out;
	}

	TRTRef<IRTBuffer> Scratch;
};

/// What Hit.rchit makes of a hit.
constexpr uint32_t HitValue(uint32_t Record, uint32_t Custom, uint32_t Section, uint32_t Primitive, bool bBack = false)
{
	return (Record << 16) | (Custom << 8) | (Section << 4) | (bBack ? 8u : 0u) | Primitive;
}

} // namespace Lantern
