// CheckGeometry: what no acceleration structure can be built from.
#include "Geometry/GeometryCheck.h"
#include "GeometryStoreTestTools.h"

namespace Lantern
{
namespace
{

class FGeometryCheckTest : public FGeometryStoreTest
{
protected:
	static std::string Check(const FRTGeometryInfo& Info, uint64_t MaxPrimitives = 1000)
	{
		const FRTStatus Status = CheckGeometry(Info, MaxPrimitives);
		return Status ? std::string() : Status.Message;
	}
};

TEST_F(FGeometryCheckTest, PrimitivesOfAllSectionsCount)
{
	FRTGeometryInfo Info = MakeInfo("Fence", 4, 3);
	EXPECT_EQ(Check(Info, 12), "");
	EXPECT_EQ(Check(Info, 11), "Fence has 12 triangles; the device allows 11");
	EXPECT_EQ(CheckGeometry(Info, 11).Code, ERTResult::Unsupported);
	Info.Aabbs = Shared;
	Info.Sections[0] = {0, 5, true, true};
	EXPECT_EQ(Check(Info, 13), "") << "boxes count each";
	EXPECT_EQ(Check(Info, 12), "Fence has 13 triangles; the device allows 12");
}

TEST_F(FGeometryCheckTest, NumberOfPrimitivesDoesNotOverflow)
{
	FRTGeometryInfo Info = MakeInfo("Fence", 1, 2);
	Info.Aabbs = Shared;
	for (FRTSectionInfo& Section : Info.Sections) { Section = {0, ~0u, true, true}; }
	EXPECT_EQ(Check(Info, 2 * uint64_t(~0u)), "");
	EXPECT_EQ(Check(Info, 2 * uint64_t(~0u) - 1), "Fence has 8589934590 triangles; the device allows 8589934589");
}

TEST_F(FGeometryCheckTest, EachBufferIsNeeded)
{
	for (TRTRef<IRTBuffer> FRTGeometryInfo::*const Buffer :
	    {&FRTGeometryInfo::Positions, &FRTGeometryInfo::Attributes, &FRTGeometryInfo::Indices})
	{
		FRTGeometryInfo Info = MakeInfo("Fence", 4, 2);
		EXPECT_EQ(Check(Info), "");
		(Info.*Buffer).Reset();
		EXPECT_EQ(Check(Info), "geometry \"Fence\", section 0: a buffer is missing");
		EXPECT_EQ(CheckGeometry(Info, 1000).Code, ERTResult::InvalidArgument);
	}
}

TEST_F(FGeometryCheckTest, ClassifiedTrianglesAreSomeOfTheSection)
{
	FRTGeometryInfo Info = MakeInfo("Tree", 4, 2);
	Info.Sections[1].OpaqueIndexCount = 6;
	Info.Sections[1].TransparentIndexCount = 6;
	EXPECT_EQ(Check(Info), "");
	Info.Sections[1].TransparentIndexCount = 9;
	EXPECT_EQ(Check(Info), "geometry \"Tree\", section 1: more classified triangles than triangles");
	Info.Sections[1].OpaqueIndexCount = Info.Sections[1].TransparentIndexCount = 1u << 31; // their sum is 0 in 32 bits
	EXPECT_EQ(Check(Info), "geometry \"Tree\", section 1: more classified triangles than triangles");
}

TEST_F(FGeometryCheckTest, NamesAreShownSafely)
{
	FRTGeometryInfo Info = MakeInfo("Two\nlines", 4);
	Info.Sections.clear();
	EXPECT_EQ(Check(Info).find('\n'), std::string::npos);
	EXPECT_NE(Check(Info).find("has no section"), std::string::npos);
}

} // namespace
} // namespace Lantern
