// What is logged about shaders that do not compile.
#include "Pipelines/RTPSOFailureLog.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "Support/CoreTestTools.h"

namespace Lantern
{
namespace
{

using ::testing::HasSubstr;

FRTStatus MakeError(const char* Text) { return FRTStatus::Error(ERTResult::CompileFailed, "%s", Text); }

TEST(RTPSOFailureLogTest, AShortageMayPassAndACompileErrorDoesNot)
{
	EXPECT_TRUE(IsShortage(FRTStatus::Error(ERTResult::OutOfDeviceMemory, "full")));
	EXPECT_TRUE(IsShortage(FRTStatus::Error(ERTResult::OutOfHostMemory, "full")));
	EXPECT_TRUE(IsShortage(FRTStatus::Error(ERTResult::OutOfDescriptors, "full")));
	EXPECT_FALSE(IsShortage(MakeError("wrong")));
	EXPECT_FALSE(IsShortage(FRTStatus::Success()));
}

TEST(RTPSOFailureLogTest, UnitsOfOneTextAreReportedOnce)
{
	FLogCapture Log;
	FRTPSOFailureLog Failures;
	Failures.ReportUnit("Rust SHADOW", 1, false, MakeError("Rust.glsl:2: wrong\nin the any-hit shader"));
	Failures.ReportUnit("Rust MATERIAL", 1, false, MakeError("Rust.glsl:2: wrong\nin the closest-hit shader"));
	ASSERT_EQ(Log.Count(ERTLogLevel::Error), 1u);
	EXPECT_THAT(Log.GetTexts()[0], HasSubstr("Rust SHADOW does not compile:\nRust.glsl:2: wrong\nin the any-hit shader"));
	Failures.ReportUnit("Rust SHADOW", 2, true, MakeError("Rust.glsl:2: wrong"));
	ASSERT_EQ(Log.Count(ERTLogLevel::Error), 2u) << "after an edit it is told again";
	EXPECT_THAT(Log.GetTexts()[1], HasSubstr("the version before stays"));
}

TEST(RTPSOFailureLogTest, ALinkErrorIsReportedOnce)
{
	FLogCapture Log;
	FRTPSOFailureLog Failures;
	for (int I = 0; I < 3; ++I) { Failures.ReportLink(MakeError("RTPSO: no")); }
	EXPECT_EQ(Log.Count(ERTLogLevel::Error), 1u);
	Failures.ReportLink(MakeError("RTPSO: another"));
	EXPECT_EQ(Log.Count(ERTLogLevel::Error), 2u);
}

} // namespace
} // namespace Lantern
