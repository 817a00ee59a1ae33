// Poisoned histories: the bits arrive, before anybody reads them, in what was asked for and only then.
#include "Support/HistoryTestTools.h"

namespace Lantern
{
namespace
{

using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class FHistoryPoisonTest : public FHistoryTestBase
{
protected:
	/// Writes 1 to a texture of the name, and reads what was there before.
	void UseTexture(FFrameGraph& Graph, const char* Name, ERTFormat Format = ERTFormat::R32_FLOAT, uint32_t Size = 4)
	{
		const FHistoryTexture Texture = Get(Name, Size, Format);
		AddWriter(Graph, Texture.Current, 1.0f);
		AddReader(Graph, Texture.Current);
		if (Texture.Previous.IsValid()) { AddReader(Graph, Texture.Previous); }
	}
	void UseTextureOnce(const char* Name, ERTFormat Format = ERTFormat::R32_FLOAT, uint32_t Size = 4)
	{
		Frame([&](FFrameGraph& Graph) { UseTexture(Graph, Name, Format, Size); });
	}
};

TEST_F(FHistoryPoisonTest, BitsArriveInEveryFormatAndAreGoneAFrameLater)
{
	for (const ERTFormat Format : {ERTFormat::R16_FLOAT, ERTFormat::RG16_FLOAT, ERTFormat::RGBA16_FLOAT, ERTFormat::R32_FLOAT,
	         ERTFormat::RG32_FLOAT, ERTFormat::RGBA32_FLOAT, ERTFormat::R11G11B10_FLOAT})
	{
		for (const uint32_t Size : {1u, 3u, 16u}) // of 3 × 3 texels of 2 bytes the last word is half
		{
			History->Clear();
			UseTextureOnce("Mean", Format, Size);
			UseTextureOnce("Mean", Format, Size);
			EXPECT_THAT(ReadBytes(), Contains(Not(0xff)));
			Resources->PoisonHistory("");
			Mock().ClearCalls();
			UseTextureOnce("Mean", Format, Size);
			EXPECT_EQ(GetPasses().at(0), "Poison");
			std::vector<uint8_t> Texels = ReadBytes();
			Texels.resize(size_t(Size) * Size * BytesPerTexel(Format));
			EXPECT_THAT(Texels, Each(0xff));
			Mock().ClearCalls();
			UseTextureOnce("Mean", Format, Size);
			EXPECT_THAT(GetPasses(), Not(Contains("Poison"))) << "once";
			EXPECT_THAT(ReadBytes(), Contains(Not(0xff))) << "what the poisoned frame wrote";
		}
	}
}

TEST_F(FHistoryPoisonTest, ThoseBitsAreNotANumber)
{
	const uint32_t Bits = ~0u;
	float Value;
	std::memcpy(&Value, &Bits, 4);
	EXPECT_TRUE(std::isnan(Value));
	EXPECT_EQ(Bits & 0x7c00u, 0x7c00u) << "of a half the exponent is full";
	EXPECT_NE(Bits & 0x3ffu, 0u) << "and the mantissa is not zero";
	EXPECT_EQ(Bits >> 22 & 0x3ffu, 0x3ffu) << "of 10 bits of R11G11B10 5 are the exponent, the rest mantissa";
}

TEST_F(FHistoryPoisonTest, BuffersAreFilledWhole)
{
	for (int Index = 0; Index < 3; ++Index)
	{
		if (Index == 2) { Resources->PoisonHistory("Cac"); }
		Frame([&](FFrameGraph& Graph) {
			const FHistoryBuffer Cache = GetBuffer("Cache", 1000);
			if (Index == 0) { AddWriter(Graph, Cache.Buffer, 7); }
			AddReader(Graph, Cache.Buffer);
		});
		EXPECT_THAT(ReadBytes(), Index == 2 ? testing::Matcher<std::vector<uint8_t>>(Each(0xff)) : Contains(7));
	}
}

TEST_F(FHistoryPoisonTest, OnlyWhatHasThePartInItsName)
{
	const auto UseBoth = [&] {
		Frame([&](FFrameGraph& Graph) {
			UseTexture(Graph, "Sun.Mean");
			UseTexture(Graph, "Sky.Mean");
		});
	};
	UseBoth();
	for (const auto& [Part, bSun, bSky] : {std::tuple{"Sun", true, false}, std::tuple{"Sky.Mean", false, true},
	         std::tuple{"Mean", true, true}, std::tuple{"Moon", false, false}})
	{
		Resources->PoisonHistory(Part);
		Mock().ClearCalls();
		UseBoth();
		EXPECT_EQ(std::isnan(ReadNewest<float>(2)), bSun) << Part;
		EXPECT_EQ(std::isnan(ReadNewest<float>(0)), bSky) << Part;
		EXPECT_EQ(Mock().CountCalls(ERTMockCall::BeginMarker, "Poison"), bSun || bSky ? 1u : 0u) << Part;
	}
	Resources->PoisonHistory("Sun");
	Resources->PoisonHistory("Sky");
	UseBoth();
	EXPECT_TRUE(std::isnan(ReadNewest<float>(0)) && std::isnan(ReadNewest<float>(2))) << "two calls add up";
}

TEST_F(FHistoryPoisonTest, WhatIsWrittenNowAndWhatIsTransientStays)
{
	UseTextureOnce("Mean");
	Resources->PoisonHistory("");
	Frame([&](FFrameGraph& Graph) {
		const FGraphTexture Mean = Graph.CreateTexture({4, 4, ERTFormat::R32_FLOAT}, "Mean too");
		AddWriter(Graph, Mean, 5.0f);
		AddReader(Graph, Mean);
		UseTexture(Graph, "Mean");
	});
	EXPECT_TRUE(std::isnan(ReadNewest<float>(0)));
	EXPECT_EQ(ReadNewest<float>(1), 1.0f);
	EXPECT_EQ(ReadNewest<float>(2), 5.0f);
}

// As the scene's tables are copied behind it: a barrier of memory as such takes along what is left written by copies.
TEST_F(FHistoryPoisonTest, BarriersOfAllThatWasCopiedDoNotDisturbIt)
{
	for (int Index = 0; Index < 4; ++Index)
	{
		if (Index > 0) { Resources->PoisonHistory(""); }
		Frame([&](FFrameGraph& Graph) {
			Graph.AddPass("Tables", [](FPassBuilder& Builder) -> FPassExecute {
				Builder.NeverCull();
				return [](FPassContext& Pass) {
					const FRTBarrier All{nullptr, nullptr, ERTAccess::CopyWrite, ERTAccess::ShaderRead | ERTAccess::IndexRead};
					Pass.Commands().Barriers(&All, 1);
				};
			});
			UseTexture(Graph, "Mean");
			const FHistoryBuffer Cache = GetBuffer();
			if (Index == 0) { AddWriter(Graph, Cache.Buffer, 7); }
			AddReader(Graph, Cache.Buffer);
		});
		EXPECT_THAT(ReadBytes(), Index > 0 ? testing::Matcher<std::vector<uint8_t>>(Each(0xff)) : Contains(7));
	}
}

TEST_F(FHistoryPoisonTest, AlsoWhatNobodyReadsInThisFrame)
{
	UseTextureOnce("Mean");
	Resources->PoisonHistory("");
	Mock().ClearCalls();
	Frame([&](FFrameGraph&) { (void)Get(); });
	EXPECT_THAT(GetPasses(), ElementsAre("Poison"));

	Frame([&](FFrameGraph& Graph) {
		const FHistoryBuffer Cache = GetBuffer();
		AddWriter(Graph, Cache.Buffer, 1);
		AddReader(Graph, Cache.Buffer);
	});
	Resources->PoisonHistory("Cache");
	Mock().ClearCalls();
	Frame([&](FFrameGraph&) { (void)GetBuffer(); });
	EXPECT_THAT(GetPasses(), ElementsAre("Poison"));
}

TEST_F(FHistoryPoisonTest, WithoutHistoryThereIsNoPass)
{
	Resources->PoisonHistory("");
	Mock().ClearCalls();
	UseTextureOnce("Mean"); // the first frame: nothing is from before
	EXPECT_THAT(GetPasses(), Not(Contains("Poison")));
	EXPECT_THAT(Mock().GetCreatedBuffers(), Not(Contains("PoisonBits")));
	Mock().ClearCalls();
	UseTextureOnce("Mean");
	EXPECT_THAT(GetPasses(), Not(Contains("Poison"))) << "it was for the frame before";
}

TEST_F(FHistoryPoisonTest, AllLevelsOfATexture)
{
	const FGraphTextureDesc Desc{8, 8, ERTFormat::RG16_FLOAT, ERTTextureUsage::CopySource, 4};
	TRTRef<IRTTexture> Kept;
	for (int Index = 0; Index < 2; ++Index)
	{
		if (Index == 1) { Resources->PoisonHistory(""); }
		Frame([&](FFrameGraph& Graph) {
			FHistoryTexture Mean;
			ASSERT_TRUE(History->GetTexture("Mean", Desc, Mean));
			AddWriter(Graph, Mean.Current, 1.0f);
			AddReader(Graph, Mean.Current);
			if (Mean.Previous.IsValid())
			{
				Graph.AddPass("Look", [&](FPassBuilder& Builder) -> FPassExecute {
					Builder.Read(Mean.Previous, ERTAccess::ShaderRead);
					Builder.NeverCull();
					return [&, Mean](FPassContext& Pass) { Kept = TRTRef<IRTTexture>(Pass.GetTexture(Mean.Previous)); };
				});
			}
		});
	}
	for (uint32_t Mip = 0; Mip < 4; ++Mip)
	{
		const std::vector<uint8_t> Texels = Mock().GetTexels(Unwrap(Kept.Get()), Mip);
		EXPECT_EQ(Texels.size(), size_t(4) << 2 * (3 - Mip));
		EXPECT_THAT(Texels, Each(0xff)) << Mip;
	}
}

TEST_F(FHistoryPoisonTest, WhatCannotBeCopiedToIsNamed)
{
	const FRTTextureDesc Desc{
	    .Width = 4, .Height = 4, .Format = ERTFormat::R32_FLOAT, .Usage = ERTTextureUsage::Sampled, .Name = "Foreign"};
	TRTRef<IRTTexture> Texture;
	ASSERT_TRUE(Device->CreateTexture(Desc, Texture.ReleaseAndGetAddress()));
	Resources->PoisonHistory("");
	FFrameGraph Graph(*Resources);
	Graph.MarkHistory(Graph.ImportTexture(Texture.Get(), ERTAccess::ShaderRead, ERTAccess::ShaderRead, "Foreign"));
	const FRTStatus Status = Graph.Compile();
	EXPECT_EQ(Status.Code, ERTResult::InvalidArgument);
	EXPECT_THAT(std::string(Status.Message), HasSubstr("'Foreign' (4x4 R32_FLOAT) cannot be poisoned"));
}

} // namespace
} // namespace Lantern
