// Sums of an audit of radiance cells against numbers by hand.
#include "LanternRenderer/RadianceAudit.h"

#include <cmath>

#include <gtest/gtest.h>

namespace Lantern
{

namespace
{

TEST(FRadianceAuditSumsTest, RatioAndItsError)
{
	FRadianceAuditSums Sums;
	EXPECT_EQ(Sums.GetRatio(), 1.0);
	EXPECT_EQ(Sums.GetStandardError(), 0.0);
	// Answers of 1 and 3; paths have twice that, and one more or less.
	Sums.Add(1.0, 3.0);
	Sums.Add(3.0, 5.0);
	FRadianceAuditSums Twice = Sums;
	Twice += Sums;
	EXPECT_DOUBLE_EQ(Sums.GetRatio(), 2.0);
	EXPECT_DOUBLE_EQ(Sums.GetStandardError(), std::sqrt(2.0 * 2.0) / 4.0); // squares of 1 and -1, two paths
	EXPECT_DOUBLE_EQ(Twice.GetRatio(), 2.0);
	EXPECT_DOUBLE_EQ(Twice.GetStandardError(), std::sqrt(4.0 * 4.0 / 3.0) / 8.0);
	Twice -= Sums;
	EXPECT_DOUBLE_EQ(Twice.GetStandardError(), Sums.GetStandardError());
}

} // namespace
} // namespace Lantern
