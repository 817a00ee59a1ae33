// Follows rays through the memory of the mock.
#include "MockRays.h"

#include <algorithm>
#include <cmath>

namespace Lantern
{
namespace
{

struct FPoint
{
	float X = 0, Y = 0, Z = 0;
};

FPoint Transform(const FRTInstance& Instance, const float* P)
{
	const float* M = Instance.Transform;
	return {M[0] * P[0] + M[1] * P[1] + M[2] * P[2] + M[3], M[4] * P[0] + M[5] * P[1] + M[6] * P[2] + M[7],
	    M[8] * P[0] + M[9] * P[1] + M[10] * P[2] + M[11]};
}

float Determinant(const float* M)
{
	return M[0] * (M[5] * M[10] - M[6] * M[9]) - M[1] * (M[4] * M[10] - M[6] * M[8]) + M[2] * (M[4] * M[9] - M[5] * M[8]);
}

/// Returns twice the signed area of the triangle's projection to z = 0.
float Area(const FPoint& A, const FPoint& B, const FPoint& C) { return (B.X - A.X) * (C.Y - A.Y) - (B.Y - A.Y) * (C.X - A.X); }

/// Where a ray meets a primitive. The rays look straight down from z = 1.
struct FMet
{
	float Distance = 0;
	bool bBack = false;
	uint32_t Mark = 0; ///< of an intersection shader
};

/// One pixel's ray. Shaders are run by name.
class FMockRay
{
public:
	FMockRay(const FRTMock& InMock, IRTShaderTable* InTable, const FContractPush& InPush, uint32_t Pixel)
	    : Mock(InMock),
	      Table(InTable),
	      Push(InPush),
	      X(static_cast<float>(Pixel) + 0.5f)
	{}

	uint32_t Run(IRTScene* Scene)
	{
		for (const FRTMockInstance& Item : Mock.GetSceneInstances(Scene))
		{
			if (Item.Geometry && (Item.Instance.CustomIndexAndMask >> 24 & Push.C) != 0) { TestInstance(Item); }
		}
		return bHit ? Value : Miss();
	}

private:
	uint32_t Miss() const
	{
		const FRTMockRecord Record = Mock.ResolveRecord(Table, ERTRecordKind::Miss, Push.F);
		if (Record.bNull) { return 0; }
		EXPECT_TRUE(Record.IsGood()) << Record.Error;
		return Record.General == "MissOne.rmiss" ? MissOne : Record.General == "MissTwo.rmiss" ? MissTwo : 0xe0000000u | Push.G;
	}
	void TestInstance(const FRTMockInstance& Item)
	{
		const std::vector<FRTGeometrySection> Sections = Mock.GetGeometry(Item.Geometry).Sections;
		for (uint32_t Section = 0; Section < Sections.size(); ++Section)
		{
			const FRTGeometrySection& Desc = Sections[Section];
			const uint32_t Count = Desc.bProcedural ? Desc.VertexCount : Desc.TriangleCount;
			for (uint32_t Primitive = 0; Primitive < Count; ++Primitive) { TestPrimitive(Item.Instance, Desc, Section, Primitive); }
		}
	}
	bool IsOpaque(const FRTInstance& Instance, const FRTGeometrySection& Desc) const
	{
		const uint32_t Flags = Instance.TableOffsetAndFlags >> 24;
		bool bOpaque = Flags & InstanceForceOpaque ? true : Flags & InstanceForceNoOpaque ? false : Desc.bOpaque;
		bOpaque = Push.B & RayOpaque ? true : Push.B & RayNoOpaque ? false : bOpaque;
		return bOpaque;
	}
	void TestPrimitive(const FRTInstance& Instance, const FRTGeometrySection& Desc, uint32_t Section, uint32_t Primitive)
	{
		const bool bOpaque = IsOpaque(Instance, Desc);
		if ((bOpaque && Push.B & RayCullOpaque) || (!bOpaque && Push.B & RayCullNoOpaque)) { return; }
		const FRTMockRecord Record = Mock.ResolveHit(Table, Instance, Section, Push.D, Push.E);
		FMet Met;
		const bool bMet = Desc.bProcedural ? MeetBox(Instance, Desc, Primitive, Record, Met) : MeetTriangle(Instance, Desc, Primitive, Met);
		if (!bMet || Met.Distance <= 0.0f || Met.Distance >= std::min(Nearest, 10.0f)) { return; }
		EXPECT_TRUE(Record.bNull || Record.IsGood()) << Record.Error;
		uint32_t RecordValue = 0;
		std::memcpy(&RecordValue, Record.Data.data(), std::min<size_t>(Record.Data.size(), 4));
		const bool bParity = Record.AnyHit == "Parity.rahit" && (RecordValue + Primitive + Push.G) % 2 != 0;
		if (!bOpaque && (Record.AnyHit == "Hole.rahit" || bParity)) { return; }
		Nearest = Met.Distance;
		bHit = true;
		Value = Push.B & RaySkipClosestHit ? 0 : Shade(Record, RecordValue, Instance, Section, Primitive, Met);
	}
	uint32_t Shade(const FRTMockRecord& Record, uint32_t RecordValue, const FRTInstance& Instance, uint32_t Section, uint32_t Primitive,
	    const FMet& Met) const
	{
		const uint32_t Custom = Instance.CustomIndexAndMask & MaxInstanceIndex;
		if (Record.ClosestHit == "Hit.rchit") { return RecordValue << 16 | Custom << 8 | Section << 4 | (Met.bBack ? 8u : 0u) | Primitive; }
		if (Record.ClosestHit == "SaltHit.rchit") { return RecordValue << 16 | Push.G << 8 | Custom; }
		if (Record.ClosestHit == "BoxHit.rchit") { return RecordValue << 16 | Met.Mark << 8 | 5u; }
		return Record.ClosestHit == "HitCalls.rchit" ? RecordValue + Push.G : 0;
	}
	const float* VertexAt(const FRTGeometrySection& Desc, uint32_t Vertex) const
	{
		const uint8_t* Bytes = Mock.GetBytes(Desc.Vertices) + Desc.VertexOffset;
		return reinterpret_cast<const float*>(Bytes + size_t(Desc.VertexStride) * Vertex);
	}
	uint32_t IndexAt(const FRTGeometrySection& Desc, uint32_t Index) const
	{
		const uint8_t* Bytes = Desc.Indices ? Mock.GetBytes(Desc.Indices) + Desc.IndexOffset : nullptr;
		switch (Desc.IndexType)
		{
		case ERTIndexType::None: return Index;
		case ERTIndexType::UInt16: return reinterpret_cast<const uint16_t*>(Bytes)[Index];
		case ERTIndexType::UInt32: return reinterpret_cast<const uint32_t*>(Bytes)[Index];
		}
		return Index;
	}
	bool MeetTriangle(const FRTInstance& Instance, const FRTGeometrySection& Desc, uint32_t Primitive, FMet& Out) const
	{
		FPoint P[3];
		for (uint32_t Corner = 0; Corner < 3; ++Corner)
		{
			P[Corner] = Transform(Instance, VertexAt(Desc, IndexAt(Desc, Primitive * 3 + Corner)));
		}
		const FPoint Eye = {X, Y, 1.0f};
		const float All = Area(P[0], P[1], P[2]);
		const float A = Area(Eye, P[1], P[2]) / All, B = Area(P[0], Eye, P[2]) / All, C = 1.0f - A - B;
		if (All == 0.0f || A < 0 || B < 0 || C < 0) { return false; }
		Out.Distance = 1.0f - (A * P[0].Z + B * P[1].Z + C * P[2].Z);
		// Winding is decided in object space: a mirroring transform does not change it.
		const uint32_t Flags = Instance.TableOffsetAndFlags >> 24;
		const bool bMirrored = Determinant(Instance.Transform) < 0;
		const bool bFlipped = Flags & InstanceFlipFacing;
		Out.bBack = (All < 0) != (bMirrored != bFlipped);
		const bool bCulled = Push.B & (Out.bBack ? RayCullBack : RayCullFront);
		return !bCulled || (Flags & InstanceCullDisable);
	}
	/// Boxes are moved, never rotated. Disc.rint reports a hit if the ray is near the box's middle, Slab.rint on its top.
	bool MeetBox(
	    const FRTInstance& Instance, const FRTGeometrySection& Desc, uint32_t Primitive, const FRTMockRecord& Record, FMet& Out) const
	{
		const float* Box = VertexAt(Desc, Primitive);
		const float AtX = X - Instance.Transform[3], AtY = Y - Instance.Transform[7];
		if (Record.Intersection == "Disc.rint")
		{
			Out.Distance = 1.0f;
			return std::hypot(AtX - (Box[0] + Box[3]) * 0.5f, AtY - (Box[1] + Box[4]) * 0.5f) < 0.4f;
		}
		Out.Mark = (Push.G + Primitive) & 0xff;
		Out.Distance = 1.0f - (Box[5] + Instance.Transform[11]);
		return Record.Intersection == "Slab.rint" && AtX >= Box[0] && AtX <= Box[3] && AtY >= Box[1] && AtY <= Box[4];
	}

	const FRTMock& Mock;
	IRTShaderTable* Table;
	const FContractPush& Push;
	float X = 0, Y = 0.25f;
	float Nearest = 10.0f;
	bool bHit = false;
	uint32_t Value = 0;
};

uint32_t CallOnMock(const FRTMock& Mock, IRTShaderTable* Table, const FContractPush& Push, uint32_t Pixel)
{
	const FRTMockRecord Record = Mock.ResolveRecord(Table, ERTRecordKind::Callable, Push.D);
	EXPECT_TRUE(Record.IsGood()) << Record.Error;
	return Record.General == "Double.rcall" ? Pixel * 2 + 1 : Record.General == "Square.rcall" ? Pixel * Pixel : Pixel + Push.G;
}

} // namespace

std::vector<uint32_t> TraceOnMock(
    const FRTMock& Mock, IRTShaderTable* Table, IRTScene* Scene, const FContractPush& Push, uint32_t Width, uint32_t RayGen)
{
	const FRTMockRecord Generate = Mock.ResolveRecord(Table, ERTRecordKind::RayGen, RayGen);
	EXPECT_TRUE(Generate.IsGood()) << Generate.Error;
	std::vector<uint32_t> Out;
	for (uint32_t Pixel = 0; Pixel < Width; ++Pixel)
	{
		Out.push_back(
		    Generate.General == "Call.rgen" ? CallOnMock(Mock, Table, Push, Pixel) : FMockRay(Mock, Table, Push, Pixel).Run(Scene));
	}
	return Out;
}

} // namespace Lantern
