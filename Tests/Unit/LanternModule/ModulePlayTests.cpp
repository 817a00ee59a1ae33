// Each argument of each call made wrong alone, and sequences that the fuzzer found (Tests/Data/ModuleCorpus).
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ModulePlay.h"

namespace Lantern
{
namespace
{

class FModulePlayTest : public ::testing::Test
{
protected:
	void SetUp() override
	{
		ASSERT_EQ(LanternCreateModule(ModuleVersion, Module.ReleaseAndGetAddress()), 0);
		FRTModuleDesc Desc;
		Desc.ShaderFolder = LANTERN_SOURCE_DIR "/Shaders";
		Desc.CacheFolder = LANTERN_TEST_CACHE;
		Desc.LogCallback = [](void*, ERTModuleLog, const char*) {};
		const FRTStatus Status = Module->Initialize(Desc);
		ASSERT_TRUE(Status.IsOk()) << Status.Message;
	}
	TRTRef<IRTModule> Module;
};

/// One test for each row, so that each row's faults are told.
class FModuleSweepTest : public FModulePlayTest, public ::testing::WithParamInterface<size_t>
{};

TEST_P(FModuleSweepTest, EveryWrongArgumentIsRefusedByNameAndChangesNothing)
{
	const size_t Row = GetParam();
	FModulePlay Good(*Module);
	ASSERT_EQ(Good.PlayDeviation(Row, 0, 0), "");
	EXPECT_TRUE(Good.GetStatus().IsOk()) << Good.GetStatus().Message;
	const size_t Choices = Good.GetChoiceCount();
	EXPECT_EQ(Good.Finish(), "");
	std::set<std::string> Problems;
	for (size_t Choice = 0; Choice < Choices; ++Choice)
	{
		FModulePlay Play(*Module);
		for (uint8_t Deviation = 1; Deviation < 8; ++Deviation)
		{
			const std::string Problem = Play.PlayDeviation(Row, Choice, Deviation);
			if (!Problem.empty()) { Problems.insert(Problem); }
			const std::string After = Play.RenderGoodFrame();
			if (!After.empty()) { Problems.insert(After); }
		}
		if (const std::string Problem = Play.Finish(); !Problem.empty()) { Problems.insert(Problem); }
	}
	EXPECT_THAT(Problems, ::testing::IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Calls, FModuleSweepTest, ::testing::Range(size_t(0), GetModuleCalls().size()),
    [](const auto& Info) { return GetModuleCalls()[Info.param].Name; });

/// What a fuzzer without memory plays: careful calls mostly, and a wrong one now and then.
TEST_F(FModulePlayTest, RandomSequences)
{
	constexpr uint32_t Sequences = 64, Length = 600;
	std::mt19937 Random(7);
	for (uint32_t Sequence = 0; Sequence < Sequences; ++Sequence)
	{
		std::vector<uint8_t> Bytes(Length);
		for (uint8_t& Byte : Bytes)
		{
			const uint32_t Kind = Random() % 8;
			Byte = static_cast<uint8_t>(Kind == 0 ? Random() : Kind == 1 ? 5 + Random() % 250 : 0);
		}
		FModulePlay Play(*Module);
		EXPECT_EQ(Play.Play(Bytes), "") << Sequence;
		EXPECT_EQ(Play.Finish(), "") << Sequence;
	}
}

TEST_F(FModulePlayTest, WhatTheFuzzerFound)
{
	size_t Count = 0;
	for (const auto& Entry : std::filesystem::directory_iterator(LANTERN_SOURCE_DIR "/Tests/Data/ModuleCorpus"))
	{
		std::ifstream Stream(Entry.path(), std::ios::binary);
		const std::vector<uint8_t> Bytes(std::istreambuf_iterator<char>(Stream), {});
		FModulePlay Play(*Module);
		EXPECT_EQ(Play.Play(Bytes), "") << Entry.path();
		EXPECT_EQ(Play.Finish(), "") << Entry.path();
		++Count;
	}
	EXPECT_GT(Count, 0u);
}

} // namespace
} // namespace Lantern
