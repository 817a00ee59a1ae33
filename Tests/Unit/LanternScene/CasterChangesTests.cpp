// FCasterChanges, and what of a scene it is told.
#include "LanternScene/Scene/CasterChanges.h"

#include <limits>

#include "Support/SceneTestTools.h"

namespace Lantern
{
namespace
{

TEST(FCasterChangesTest, KeepsTheLastOnes)
{
	FCasterChanges Changes;
	std::vector<FCasterChange> Found(3);
	EXPECT_TRUE(Changes.Find(0, Found));
	EXPECT_TRUE(Found.empty());
	for (uint32_t I = 0; I < FCasterChanges::MostKept; ++I) { Changes.Add({{I, 0, 0}, {I, 1, 0}, 2.0}); }
	ASSERT_TRUE(Changes.Find(0, Found));
	ASSERT_EQ(Found.size(), FCasterChanges::MostKept);
	EXPECT_EQ(Found[7].From.x, 7.0);
	EXPECT_EQ(Found[7].To.y, 1.0);
	Changes.Add({{1000, 0, 0}, {1000, 1, 0}, 2.0});
	EXPECT_FALSE(Changes.Find(0, Found)) << "the first is forgotten";
	ASSERT_TRUE(Changes.Find(FCasterChanges::MostKept, Found));
	ASSERT_EQ(Found.size(), 1u);
	EXPECT_EQ(Found[0].From.x, 1000.0);
}

TEST(FCasterChangesTest, AnywhereHoldsForThoseBeforeIt)
{
	FCasterChanges Changes;
	std::vector<FCasterChange> Found;
	Changes.AddAnywhere();
	EXPECT_FALSE(Changes.Find(0, Found));
	EXPECT_TRUE(Changes.Find(1, Found));
	const double NaN = std::numeric_limits<double>::quiet_NaN();
	Changes.Add({{0, NaN, 0}, {0, 0, 0}, 1.0});
	EXPECT_FALSE(Changes.Find(1, Found)) << "a place that is no number may be any";
	Changes.Add({{0, 0, 0}, {0, 0, 0}, std::numeric_limits<double>::infinity()});
	EXPECT_FALSE(Changes.Find(2, Found));
	EXPECT_TRUE(Changes.Find(3, Found));
}

} // namespace
} // namespace Lantern
