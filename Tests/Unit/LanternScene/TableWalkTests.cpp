// FSectionTable and FShaderTable over random walks, for devices of all alignments and all numbers of frames in
// flight. A failure names its seed and prints the fewest steps that still fail.
#include <algorithm>
#include <ostream>

#include <gtest/gtest.h>

#include "TableWalk.h"

namespace Lantern
{

void PrintTo(const FWalkSettings& Settings, std::ostream* Out)
{
	*Out << Settings.HandleSize << "/" << Settings.HandleAlignment << "/" << Settings.BaseAlignment << ", " << Settings.InFlight
	     << " in flight";
}

namespace
{

constexpr uint32_t SeedCount = 40, StepCount = 500;

class FTableWalkTest : public ::testing::TestWithParam<FWalkSettings>
{};

TEST_P(FTableWalkTest, EveryRecordThatARayReachesIsTheModels)
{
	FWalkResult Sum;
	const uint32_t FirstSeed = GetParam().BaseAlignment * 1000 + GetParam().HandleAlignment * 100 + GetParam().InFlight * 10'000'000;
	for (uint32_t Seed = 1; Seed <= SeedCount; ++Seed)
	{
		const std::vector<FWalkStep> Steps = MakeWalk(FirstSeed + Seed, StepCount);
		const FWalkResult Result = RunWalk(GetParam(), Steps);
		if (!Result.Failure.empty())
		{
			const std::vector<FWalkStep> Fewest = ShrinkWalk(GetParam(), {Steps.begin(), Steps.begin() + Result.Step + 1});
			FAIL() << "seed " << FirstSeed + Seed << ", step " << Result.Step << ": " << Result.Failure
			       << "\nfewest steps: " << Fewest.size() << ToString(Fewest) << "\n"
			       << RunWalk(GetParam(), Fewest).Failure;
		}
		Sum.Frames += Result.Frames;
		Sum.RecordsChecked += Result.RecordsChecked;
		Sum.Growths += Result.Growths;
		Sum.Swaps += Result.Swaps;
		Sum.LostFrames += Result.LostFrames;
		Sum.FailedFrames += Result.FailedFrames;
	}
	// Walks that have become too tame say little.
	EXPECT_GT(Sum.Frames, SeedCount * StepCount / 5);
	EXPECT_GT(Sum.RecordsChecked, 50u * Sum.Frames);
	EXPECT_GT(Sum.Growths, SeedCount);
	EXPECT_GT(Sum.Swaps, 10 * SeedCount);
	EXPECT_GT(Sum.LostFrames, SeedCount);
	EXPECT_GT(Sum.FailedFrames, 0u);
}

std::vector<FWalkSettings> MakeSettings()
{
	std::vector<FWalkSettings> All;
	for (uint32_t InFlight = 0; InFlight < 4; ++InFlight)
	{
		All.push_back({32, 16, 32, InFlight});
		All.push_back({32, 32, 64, InFlight});
		All.push_back({32, 64, 64, InFlight});
		All.push_back({64, 64, 256, InFlight});
	}
	return All;
}

static_assert(SeedCount * StepCount * 16 >= 100'000);
INSTANTIATE_TEST_SUITE_P(Devices, FTableWalkTest, ::testing::ValuesIn(MakeSettings()));

TEST(TableWalk, FindsOneWrongRecordAndShrinksToIt)
{
	const FWalkSettings Settings;
	std::vector<FWalkStep> Steps = MakeWalk(7, 300);
	// Writing everything each frame would put it right again.
	std::erase_if(Steps, [](const FWalkStep& Step) { return Step.Kind == EWalkStep::ToggleMode; });
	const size_t Before = Steps.size();
	Steps.push_back({EWalkStep::AddObject, 3, 5, 0});
	Steps.push_back({EWalkStep::Frame, 0, 0, 0});
	Steps.push_back({EWalkStep::Corrupt, 0, 0, 0});
	Steps.push_back({EWalkStep::SwapPipeline, 4, 6, 0});
	Steps.insert(Steps.end(), 8, {EWalkStep::Frame, 1, 0, 0});
	const FWalkResult Result = RunWalk(Settings, Steps);
	ASSERT_FALSE(Result.Failure.empty());
	EXPECT_GT(Result.Step, Before);
	const std::vector<FWalkStep> Fewest = ShrinkWalk(Settings, {Steps.begin(), Steps.begin() + Result.Step + 1});
	EXPECT_LE(Fewest.size(), 8u) << ToString(Fewest);
	EXPECT_EQ(std::count_if(Fewest.begin(), Fewest.end(), [](const FWalkStep& Step) { return Step.Kind == EWalkStep::Corrupt; }), 1);
}

} // namespace
} // namespace Lantern
