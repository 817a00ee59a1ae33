// Shortage of device memory wherever the RTPSO compiler makes a pipeline: an error or an older version, and all of it once there is
// memory again.
#include "RTPSOTestTools.h"

namespace Lantern
{
namespace
{

using ::testing::HasSubstr;

/// With libraries, with general groups in the link, and with one link that compiles everything.
enum class EWay : uint8_t
{
	Libraries,
	OwnGeneralGroups,
	Monolithic
};

class FPipelineShortageTest : public FPipelineTest, public ::testing::WithParamInterface<EWay>
{
protected:
	void SetUp() override
	{
		FPipelineTest::SetUp();
		ASSERT_NO_FATAL_FAILURE(StartAnew());
	}
	void StartAnew()
	{
		FRTMockDesc Desc;
		Desc.bLibraryOnlyPipelines = GetParam() == EWay::Libraries;
		Desc.bPipelineLibraries = GetParam() != EWay::Monolithic;
		Device->Open();
		Start(Desc);
		Rust = AddProgram("Rust");
		Leaves = AddProgram("Leaves", ERTHitClass::Masked);
		Wanted.Callables = {MakeShader("Call")};
	}
	void ExpectComplete()
	{
		ExpectOwn(Opaque(StandardProgram), "");
		ExpectOwn(Opaque(Rust), "Rust");
		ExpectOwn(Masked(Leaves), "Leaves");
		EXPECT_EQ(Maker->GetCurrent()->GetMissingCount(), 0u);
		EXPECT_NE(Maker->GetCurrent()->FindRayGen(Wanted.RayGens[0]), NoRayGen);
	}
	/// Parts of the names of all that the driver is asked for.
	std::vector<std::string> GetPlaces()
	{
		FinishWanted();
		std::vector<std::string> Places = Device->GetAsked();
		std::sort(Places.begin(), Places.end());
		Places.erase(std::unique(Places.begin(), Places.end()), Places.end());
		return Places;
	}

	uint32_t Rust = 0, Leaves = 0;
};

TEST_P(FPipelineShortageTest, FinishNamesThePlaceAndSucceedsOnceThereIsMemory)
{
	const std::vector<std::string> Places = GetPlaces();
	ASSERT_GE(Places.size(), GetParam() == EWay::Monolithic ? 1u : 4u);
	for (const std::string& Place : Places)
	{
		SCOPED_TRACE(Place);
		ASSERT_NO_FATAL_FAILURE(StartAnew());
		Device->Mock().StarveCompiles(Place);
		for (int I = 0; I < 3; ++I)
		{
			Device->ForgetAsked();
			const FRTStatus Status = Maker->Finish(Wanted);
			EXPECT_EQ(Status.Code, ERTResult::OutOfDeviceMemory);
			EXPECT_THAT(std::string(Status.Message), HasSubstr(Place));
			EXPECT_TRUE(Device->WasAsked(Place)) << "each call tries again";
			EXPECT_FALSE(Maker->GetCurrent());
		}
		Device->Mock().ClearCompileFaults();
		FinishWanted();
		ExpectComplete();
	}
}

TEST_P(FPipelineShortageTest, FramesGoOnAndTryAgainUntilThereIsMemory)
{
	for (const std::string& Place : GetPlaces())
	{
		SCOPED_TRACE(Place);
		ASSERT_NO_FATAL_FAILURE(StartAnew());
		FLogCapture Log;
		Device->Mock().StarveCompiles(Place);
		ASSERT_NO_FATAL_FAILURE(UntilIdle());
		EXPECT_TRUE(Device->WasAsked(Place));
		if (Place == "RTPSO") { EXPECT_FALSE(Maker->GetCurrent()); }
		Device->Mock().ClearCompileFaults();
		ASSERT_NO_FATAL_FAILURE(Until([&] {
			const auto Current = Maker->GetCurrent();
			const auto IsOwn = [&](FHitProgram Program) { return Current->GetState(Program) == ERTHitState::Ready; };
			return Current && std::all_of(Wanted.HitPrograms.begin(), Wanted.HitPrograms.end(), IsOwn);
		}));
		ASSERT_NO_FATAL_FAILURE(UntilIdle());
		ExpectComplete();
		EXPECT_EQ(Log.Count(ERTLogLevel::Error), 0u) << ::testing::PrintToString(Log.GetTexts());
	}
}

TEST_P(FPipelineShortageTest, FinishKeepsTheOlderVersionAndDoesNotWaitForMemory)
{
	FinishWanted();
	const auto Before = Maker->GetCurrent();
	Programs->Edit(Rust, {.Name = "Rust", .Text = "float Value() { return 7.5; }\n"});
	const std::string Place = GetParam() == EWay::Monolithic ? "RTPSO" : "Rust MATERIAL opaque";
	Device->Mock().StarveCompiles(Place);
	Device->ForgetAsked();
	FRTStatus Status;
	{
		// Another edit makes the compiler find that the device is lost, which ends a Finish that waits for ever.
		const auto LetGo = [&] {
			Folder.Write("Materials/Material.glsl", "float Value() { return 4.0; }\n");
			Device->Mock().LoseDevice();
			Maker->Reload();
		};
		const FHangGuard Guard("the end of Finish without memory", LetGo);
		Status = Maker->Finish(Wanted);
	}
	EXPECT_TRUE(Device->WasAsked(Place));
	// A link has no older version of the same: nothing but the error would say that the picture is not what was asked for.
	EXPECT_EQ(Status.Code, GetParam() == EWay::Monolithic ? ERTResult::OutOfDeviceMemory : ERTResult::Ok) << Status.Message;
	ASSERT_TRUE(Maker->GetCurrent());
	EXPECT_EQ(Maker->GetCurrent(), Before);
	ExpectComplete();
	Device->Mock().ClearCompileFaults();
	FinishWanted();
	EXPECT_NE(Maker->GetCurrent(), Before) << "the next call tries again";
	ExpectComplete();
}

TEST_P(FPipelineShortageTest, FinishTriesALinkAgainThatFramesHadNoMemoryFor)
{
	Device->Mock().StarveCompiles("RTPSO");
	ASSERT_NO_FATAL_FAILURE(UntilIdle());
	EXPECT_TRUE(Device->WasAsked("RTPSO"));
	Device->Mock().ClearCompileFaults();
	FinishWanted();
	ExpectComplete();
}

INSTANTIATE_TEST_SUITE_P(Ways, FPipelineShortageTest, ::testing::Values(EWay::Libraries, EWay::OwnGeneralGroups, EWay::Monolithic),
    [](const auto& Info) {
	return std::string(Info.param == EWay::Libraries ? "Libraries" : Info.param == EWay::OwnGeneralGroups ? "OwnGroups" : "Monolithic");
});

} // namespace
} // namespace Lantern
