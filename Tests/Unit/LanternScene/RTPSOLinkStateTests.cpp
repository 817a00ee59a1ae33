// The states of a link, and which pipelines are kept, without a device.
#include "Pipelines/RTPSOLinkState.h"

#include <gtest/gtest.h>

namespace Lantern
{
namespace
{

class FRTPSOLinkStateTest : public ::testing::Test
{
protected:
	static FLinkPlan MakePlan(uint64_t Key)
	{
		FLinkPlan Plan;
		Plan.Key = {Key};
		Plan.bComplete = true;
		return Plan;
	}
	/// Links and takes. The pipeline is alive while the result does not expire.
	std::weak_ptr<const FRTPSO> Make(uint64_t Key, bool bExact, uint64_t Frame)
	{
		EXPECT_TRUE(Links.Ask(MakePlan(Key), bExact));
		FLinkPlan Plan = Links.Begin();
		EXPECT_EQ(Plan.Key, std::vector<uint64_t>{Key});
		Links.End(FRTStatus::Success(), std::make_shared<const FRTPSO>(), std::move(Plan), Frame);
		EXPECT_TRUE(Links.Take(Frame));
		return Links.GetCurrent().Pipeline;
	}
	void FailLink(uint64_t Key, ERTResult Result)
	{
		ASSERT_TRUE(Links.Ask(MakePlan(Key), false));
		FLinkPlan Plan = Links.Begin();
		Links.End(FRTStatus::Error(Result, "wrong"), nullptr, std::move(Plan), 1);
		EXPECT_FALSE(Links.Take(1));
	}
	void Drop(uint64_t Frame, uint64_t KeepFrames)
	{
		Links.DropRetired(Frame, Trash);
		Links.DropOld(Frame, KeepFrames, Trash);
		Trash.Take();
	}

	FRTPSOLinkState Links;
	FTrash Trash;
};

TEST_F(FRTPSOLinkStateTest, ALinkGoesThroughItsStates)
{
	EXPECT_TRUE(Links.IsIdle());
	ASSERT_TRUE(Links.Ask(MakePlan(1), false));
	EXPECT_TRUE(Links.IsAsked());
	EXPECT_TRUE(Links.IsUnderWay());
	FLinkPlan Plan = Links.Begin();
	EXPECT_FALSE(Links.IsAsked());
	EXPECT_TRUE(Links.IsUnderWay());
	const auto Pipeline = std::make_shared<const FRTPSO>();
	Links.End(FRTStatus::Success(), Pipeline, std::move(Plan), 1);
	EXPECT_TRUE(Links.IsDone());
	EXPECT_FALSE(Links.IsUnderWay());
	EXPECT_EQ(Links.GetCurrent().Pipeline, nullptr) << "not before it is taken";
	EXPECT_TRUE(Links.Take(1));
	EXPECT_TRUE(Links.IsIdle());
	EXPECT_EQ(Links.GetCurrent().Pipeline, Pipeline);
}

TEST_F(FRTPSOLinkStateTest, AFailedLinkKeepsTheCurrentPipelineAndIsRemembered)
{
	const auto Current = Make(1, false, 1).lock();
	FailLink(2, ERTResult::CompileFailed);
	EXPECT_EQ(Links.GetCurrent().Pipeline, Current);
	EXPECT_EQ(Links.GetStatus().Code, ERTResult::CompileFailed);
	EXPECT_TRUE(Links.HasFailed(MakePlan(2)));
	EXPECT_FALSE(Links.HasFailed(MakePlan(1)));
	Links.ForgetFailure();
	EXPECT_FALSE(Links.HasFailed(MakePlan(2)));
	FailLink(3, ERTResult::DeviceLost);
	EXPECT_FALSE(Links.HasFailed(MakePlan(3))) << "the plan is not to blame";
}

TEST_F(FRTPSOLinkStateTest, APipelineOnTheWayIsKeptForFramesInFlight)
{
	const auto First = Make(1, false, 10);
	Make(2, false, 20);
	Drop(24, 1000);
	EXPECT_FALSE(First.expired()) << "four frames may be in flight";
	Drop(25, 1000);
	EXPECT_TRUE(First.expired());
}

TEST_F(FRTPSOLinkStateTest, APipelineOfFinishComesBackWithoutALink)
{
	const auto First = Make(1, true, 1).lock();
	const auto Second = Make(2, true, 2).lock();
	Drop(50, 1000);
	EXPECT_FALSE(Links.Ask(MakePlan(1), true)) << "kept";
	EXPECT_TRUE(Links.IsDone());
	EXPECT_TRUE(Links.GetStatus());
	EXPECT_TRUE(Links.Take(51));
	EXPECT_EQ(Links.GetCurrent().Pipeline, First);
	EXPECT_FALSE(Links.Ask(MakePlan(2), true));
	EXPECT_TRUE(Links.Take(52));
	EXPECT_EQ(Links.GetCurrent().Pipeline, Second);
}

TEST_F(FRTPSOLinkStateTest, EightPipelinesOfFinishAreKeptAndNoneForEver)
{
	std::vector<std::weak_ptr<const FRTPSO>> Made;
	for (uint64_t Key = 0; Key < 10; ++Key) { Made.push_back(Make(Key, true, 1)); }
	Drop(6, 1000);
	EXPECT_TRUE(Made[0].expired()) << "one is current, eight are kept";
	for (size_t I = 1; I < Made.size(); ++I) { EXPECT_FALSE(Made[I].expired()) << I; }
	Drop(11, 10);
	EXPECT_FALSE(Made[1].expired());
	Drop(12, 10);
	for (size_t I = 1; I + 1 < Made.size(); ++I) { EXPECT_TRUE(Made[I].expired()) << I; }
	EXPECT_FALSE(Made.back().expired()) << "the current one stays";
}

} // namespace
} // namespace Lantern
