// FTableLayout: strides and regions under the alignments that devices have, and growth.
#include "LanternRHICommon/TableLayout.h"

#include <gtest/gtest.h>

namespace Lantern
{
namespace
{

FRTCapabilities MakeCapabilities(uint32_t HandleSize, uint32_t HandleAlignment, uint32_t BaseAlignment)
{
	FRTCapabilities Capabilities;
	Capabilities.ShaderGroupHandleSize = HandleSize;
	Capabilities.ShaderGroupHandleAlignment = HandleAlignment;
	Capabilities.ShaderGroupBaseAlignment = BaseAlignment;
	return Capabilities;
}

FRTShaderTableDesc MakeDesc(const FRecordCounts& Counts, uint32_t DataBytes)
{
	FRTShaderTableDesc Desc;
	SetRecordCounts(Desc, Counts);
	Desc.RecordDataBytes = DataBytes;
	return Desc;
}

TEST(TableLayout, CountsFollowTheKinds)
{
	FRTShaderTableDesc Desc;
	Desc.RayGenCount = 1;
	Desc.MissCount = 2;
	Desc.HitCount = 3;
	Desc.CallableCount = 4;
	EXPECT_EQ(GetRecordCounts(Desc), (FRecordCounts{1, 2, 3, 4}));
	SetRecordCounts(Desc, {5, 6, 7, 8});
	EXPECT_EQ(Desc.RayGenCount, 5u);
	EXPECT_EQ(Desc.MissCount, 6u);
	EXPECT_EQ(Desc.HitCount, 7u);
	EXPECT_EQ(Desc.CallableCount, 8u);
}

TEST(TableLayout, RegionsStartAtTheBaseAlignment)
{
	// NVIDIA's alignments; 32 bytes of data.
	const FTableLayout Layout(MakeCapabilities(32, 32, 64), MakeDesc({2, 3, 5, 1}, 32));
	EXPECT_EQ(Layout.Strides, (std::array<uint64_t, 4>{64, 32, 64, 32}));
	EXPECT_EQ(Layout.Offsets, (std::array<uint64_t, 4>{0, 128, 256, 576}));
	EXPECT_EQ(Layout.Size, 608u);
	EXPECT_EQ(Layout.GetOffset(2, 4), 256u + 4 * 64);
	EXPECT_EQ(Layout.GetRegionBytes(1), 96u);
}

TEST(TableLayout, StridesAreMultiplesOfTheHandleAlignment)
{
	// lavapipe's alignments: data that does not fill the last step.
	EXPECT_EQ(FTableLayout(MakeCapabilities(32, 16, 32), MakeDesc({1, 1, 1, 1}, 17)).Strides, (std::array<uint64_t, 4>{32, 32, 64, 32}));
	// A handle alignment above the handle's size.
	EXPECT_EQ(FTableLayout(MakeCapabilities(32, 64, 64), MakeDesc({1, 1, 1, 1}, 0)).Strides, (std::array<uint64_t, 4>{64, 64, 64, 64}));
	// A handle alignment above the base alignment holds for ray generation records too.
	EXPECT_EQ(FTableLayout(MakeCapabilities(32, 64, 32), MakeDesc({1, 1, 1, 1}, 0)).Strides[0], 64u);
}

TEST(TableLayout, EmptyKindsTakeNoRoom)
{
	const FTableLayout Layout(MakeCapabilities(32, 32, 64), MakeDesc({1, 0, 0, 0}, 0));
	EXPECT_EQ(Layout.Size, 64u);
	EXPECT_EQ(Layout.GetRegionBytes(2), 0u);
	EXPECT_EQ(FTableLayout(MakeCapabilities(32, 32, 64), MakeDesc({0, 0, 0, 0}, 0)).Size, 0u);
}

TEST(TableLayout, OtherCountsKeepTheStrides)
{
	FTableLayout Layout(MakeCapabilities(32, 32, 64), MakeDesc({1, 1, 4, 0}, 4));
	const std::array<uint64_t, 4> Strides = Layout.Strides;
	Layout.SetCounts({1, 3, 100, 2});
	EXPECT_EQ(Layout.Strides, Strides);
	EXPECT_EQ(Layout.Offsets, (std::array<uint64_t, 4>{0, 64, 192, 192 + 6400}));
	EXPECT_EQ(Layout.Size, 192u + 6400 + 64);
}

TEST(TableLayout, NoKindShrinks)
{
	const FRecordCounts Has = {2, 2, 10, 0};
	const uint32_t Fewer[4] = {1, 0, 9, 0}, Mixed[4] = {1, 3, 10, 4};
	EXPECT_EQ(GrowRecordCounts(Has, Fewer), Has);
	EXPECT_EQ(GrowRecordCounts(Has, Mixed), (FRecordCounts{2, 3, 10, 4}));
}

} // namespace
} // namespace Lantern
