// FInstanceStore and FInstanceGather against the straightforward loop over all objects.
#include <cmath>
#include <set>

#include "GatherTestTools.h"

namespace Lantern
{
namespace
{

using FRandom = std::mt19937;

double Uniform(FRandom& Random, double Low, double High) { return std::uniform_real_distribution<double>(Low, High)(Random); }

/// On a lattice whose distances are often exactly those of MakeRule's limits.
glm::dvec3 RandomPlace(FRandom& Random, double Extent, const glm::dvec3& Middle)
{
	glm::dvec3 At(Uniform(Random, -Extent, Extent), Uniform(Random, -20, 20), Uniform(Random, -Extent, Extent));
	if (Random() % 2 == 0) { At = glm::round(At / 25.0) * 25.0; }
	return Middle + At;
}

double RandomRadius(FRandom& Random)
{
	const double Choices[] = {0.0, 0.5, 1.0, 5.0, 25.0, 400.0, -1.0};
	return Random() % 3 == 0 ? Choices[Random() % 7] : std::exp(Uniform(Random, -2, 4));
}

FInstancePlacement RandomPlacement(FRandom& Random, double Extent, const glm::dvec3& Middle)
{
	FInstancePlacement Placement = PlaceAt(RandomPlace(Random, Extent, Middle), RandomRadius(Random), Random() % 12);
	if (Random() % 4 == 0)
	{
		Placement.Transform[0] *= -1.5; // mirrored and stretched, and zeros with a sign
		Placement.Center += glm::dvec3(3, 1, -2);
	}
	Placement.Group = Random() % 5 == 0 ? 1 + Random() % 6 : 0;
	Placement.Mask = Random() % 3 == 0 ? static_cast<uint8_t>(Random()) : 0xff;
	return Placement;
}

FCullingRule MakeRule(FRandom& Random, double Extent, const glm::dvec3& Middle)
{
	FGatherView View(RandomPlace(Random, Extent, Middle), {0, 0, -1}, 1.0f, Random() % 4 == 0 ? 0u : 720u);
	if (Random() % 3 != 0)
	{
		View.Forward = {static_cast<float>(Uniform(Random, -1, 1)), 0.2f, static_cast<float>(Uniform(Random, -1, 1))};
	}
	FCullingSettings Settings;
	Settings.bEnabled = Random() % 10 != 0;
	const float Radii[] = {0, 25, 100, 500, 1e9f};
	const float Angles[] = {0, 0.5f, 2, 30, 90};
	const float Pixels[] = {0, 0, 2, 24, 300};
	Settings.Radius = Radii[Random() % 5];
	Settings.RadiusBehind = Radii[Random() % 5];
	Settings.Angle = Angles[Random() % 5];
	Settings.AngleBehind = Angles[Random() % 5];
	Settings.ShadowMinPixels = Pixels[Random() % 5];
	Settings.VisibleMinPixels = Pixels[Random() % 5];
	return FCullingRule(View, Settings);
}

/// Each object is in one bucket, at the place where its record says; bounds hold their objects.
void ExpectConsistent(const FInstanceStore& Store)
{
	uint32_t Seen = 0;
	for (size_t Index = 0; Index < Store.GetBucketCapacity(); ++Index)
	{
		const FInstanceBucket* const Bucket = Store.GetBucket(Index);
		if (!Bucket) { continue; }
		ASSERT_GT(Bucket->Count, 0u);
		for (uint32_t Lane = 0; Lane < Bucket->Count; ++Lane, ++Seen)
		{
			const FInstanceRecord& Record = Store.GetRecord(Bucket->Object(Lane));
			ASSERT_TRUE(Record.bAlive);
			ASSERT_EQ(Record.Bucket, Index);
			ASSERT_EQ(Record.Lane, Lane);
			ASSERT_EQ(Record.Cell, Bucket->Cell);
			ASSERT_EQ(Record.Group, Bucket->Group);
			const FBucketBounds& Bounds = Store.GetBounds();
			const glm::dvec3 Middle(Bounds.X[Index], Bounds.Y[Index], Bounds.Z[Index]);
			ASSERT_LE(glm::distance(Middle, Record.Center), Bounds.Extent[Index] + 1e-6 * glm::length(Middle) + 1e-4);
			ASSERT_LE(Bounds.RMin[Index], static_cast<float>(Record.Radius));
			ASSERT_GE(Bounds.RMax[Index], static_cast<float>(Record.Radius));
		}
	}
	ASSERT_EQ(Seen, Store.GetCount());
}

void RunRandomSteps(uint32_t Seed, int Steps, double Extent, const glm::dvec3& Middle)
{
	FRandom Random(Seed);
	FGatherWorld World;
	for (uint32_t Range = 0; Range < 12; ++Range)
	{
		World.Store.SetBinding(Range, {Range == 3 ? 0ull : 0x1000ull * (Range + 1), Range * 7 | (Range % 5 << 24)});
	}
	std::vector<uint32_t> Alive, Free;
	uint32_t Next = 0;
	for (int Step = 0; Step < Steps; ++Step)
	{
		const uint32_t Choice = Random() % 100;
		if (Alive.empty() || (Choice < 40 && Alive.size() < 3000))
		{
			const uint32_t Object = Free.empty() ? Next++ : Free.back();
			if (!Free.empty()) { Free.pop_back(); }
			World.Set(Object, RandomPlacement(Random, Extent, Middle));
			Alive.push_back(Object);
		}
		else if (Choice < 70)
		{
			const uint32_t Object = Alive[Random() % Alive.size()];
			FInstancePlacement Placement = RandomPlacement(Random, Extent, Middle);
			if (Random() % 2 == 0)
			{
				const FInstanceRecord& Record = World.Store.GetRecord(Object);
				const double Far = std::exp(Uniform(Random, -6, 4));
				Placement = PlaceAt(
				    Record.Center + glm::dvec3(Uniform(Random, -Far, Far), 0, Uniform(Random, -Far, Far)), Record.Radius, Record.Range);
			}
			World.Set(Object, Placement);
		}
		else if (Choice < 90)
		{
			const size_t Which = Random() % Alive.size();
			World.Store.Remove(Alive[Which]);
			Free.push_back(Alive[Which]);
			Alive[Which] = Alive.back();
			Alive.pop_back();
		}
		else if (Choice < 95) { World.Store.SetRange(Alive[Random() % Alive.size()], Random() % 12); }
		else if (Choice < 97)
		{
			World.Store.SetBinding(Random() % 12, {Random() % 3 == 0 ? 0u : Random(), static_cast<uint32_t>(Random())});
		}
		if (Step % 37 == 0)
		{
			const FCullingRule Rule = MakeRule(Random, Extent, Middle);
			ASSERT_NO_FATAL_FAILURE(World.ExpectSame(Rule, FindOrigin(Rule.Eye))) << "step " << Step;
			ASSERT_NO_FATAL_FAILURE(ExpectConsistent(World.Store)) << "step " << Step;
		}
	}
	while (!Alive.empty())
	{
		World.Store.Remove(Alive.back());
		Alive.pop_back();
	}
	World.Store.Refresh();
	EXPECT_EQ(World.Store.GetBucketCount(), 0u);
	EXPECT_EQ(World.Store.GetGroups().front().Members.size(), 0u);
}

TEST(GatherStore, EqualsTheStraightforwardLoopOverRandomSteps)
{
	for (uint32_t Seed = 0; Seed < 24; ++Seed)
	{
		ASSERT_NO_FATAL_FAILURE(RunRandomSteps(Seed, 4000, Seed % 2 == 0 ? 300.0 : 3000.0, {0, 0, 0})) << Seed;
	}
}

TEST(GatherStore, EqualsTheStraightforwardLoopFarFromTheOrigin)
{
	ASSERT_NO_FATAL_FAILURE(RunRandomSteps(11, 4000, 500.0, {16'000, 200, -16'000}));
	ASSERT_NO_FATAL_FAILURE(RunRandomSteps(12, 2000, 500.0, {5e6, 0, -3e6}));
}

/// So close to a limit that fp32 cannot tell on which side.
TEST(GatherStore, ObjectsOnTheVeryLimitAreDecidedAlike)
{
	FRandom Random(17);
	for (int Try = 0; Try < 60; ++Try)
	{
		FGatherWorld World;
		World.Store.SetBinding(0, {64, 0});
		FCullingSettings Settings;
		Settings.Radius = Try % 2 == 0 ? 700.0f : 0.0f;
		Settings.RadiusBehind = Try % 3 == 0 ? 300.0f : Settings.Radius;
		Settings.Angle = Settings.AngleBehind = Try % 2 == 0 ? 80.0f : 1.0f;
		Settings.ShadowMinPixels = Try % 5 == 0 ? 30.0f : 0.0f;
		const glm::dvec3 Eye = RandomPlace(Random, Try % 4 == 0 ? 15'000 : 500, {});
		const FCullingRule Rule(FGatherView(Eye, {0.6f, 0, -0.8f}, 1.0f, 720), Settings);
		for (uint32_t I = 0; I < 1500; ++I)
		{
			const double Angle = Uniform(Random, 0, 6.2831853), Radius = Uniform(Random, 2, 3.9);
			const glm::dvec3 Away(std::cos(Angle), Uniform(Random, -0.1, 0.1), std::sin(Angle));
			const int Side = glm::dot(Away, Rule.Forward) < 0 ? 1 : 0;
			double Limit = std::max(Rule.Radius[Side] + Radius, Radius * Rule.InverseSine[Side]);
			if (Rule.bShadowLimit && I % 2 == 0) { Limit = Radius * Rule.ShadowScale; }
			const double Nearly = 1.0 + Uniform(Random, -1, 1) * std::pow(10.0, Uniform(Random, -12, -6));
			glm::dvec3 At = Eye + glm::normalize(Away) * (Limit * Nearly);
			if (I % 10 == 0) // as close to the border between before and behind
			{
				const glm::dvec3 Across(-Rule.Forward.z, 0, Rule.Forward.x);
				At = Eye - Rule.Forward * (Radius * Nearly) + Across * Uniform(Random, 250, 800);
			}
			World.Set(I, PlaceAt(At, Radius));
		}
		ASSERT_NO_FATAL_FAILURE(World.ExpectSame(Rule, FindOrigin(Eye))) << "try " << Try;
	}
}

TEST(GatherStore, ObjectsInOnePlaceAndWithoutNumbersAreKeptToo)
{
	FGatherWorld World;
	World.Store.SetBinding(0, {64, 0});
	for (uint32_t I = 0; I < 500; ++I) { World.Set(I, PlaceAt({5, 5, 5}, 1.0)); }
	const double Nan = std::nan("");
	World.Set(500, PlaceAt({Nan, 0, 0}, 1.0));
	World.Set(501, PlaceAt({1e30, -1e200, 0}, 1.0));
	World.Set(502, PlaceAt({0, 0, 0}, Nan));
	World.Store.Refresh();
	EXPECT_EQ(World.Gather.Count(World.Store, FCullingRule({}, {})), 503u) << "what has no place is never culled";
	EXPECT_LE(World.Store.GetBucketCount(), 8u + 3u);
	for (uint32_t I = 0; I < 500; ++I) { World.Store.Remove(I); }
	EXPECT_LE(World.Store.GetBucketCount(), 3u);
}

TEST(GatherStore, SaysWhetherAnotherSetCameOut)
{
	FRandom Random(3);
	FGatherWorld World;
	World.Store.SetBinding(0, {64, 0});
	for (uint32_t I = 0; I < 2000; ++I) { World.Set(I, PlaceAt({10.0 * (I % 50), 0, 10.0 * (I / 50)}, 1.0)); }
	World.Store.Refresh();
	FCullingSettings Settings;
	Settings.Radius = Settings.RadiusBehind = 102.3f;
	Settings.Angle = Settings.AngleBehind = 45.0f;
	World.Gather.Count(World.Store, FCullingRule(glm::dvec3(200, 0, 200), Settings));
	EXPECT_TRUE(World.Gather.HasChanged()) << "the first one";
	World.Gather.Count(World.Store, FCullingRule(glm::dvec3(200.001, 0, 200), Settings));
	EXPECT_FALSE(World.Gather.HasChanged()) << "a millimetre";
	World.Gather.Count(World.Store, FCullingRule(glm::dvec3(205, 0, 200), Settings));
	EXPECT_TRUE(World.Gather.HasChanged());
	World.Set(7, PlaceAt({70, 0, 0}, 1.0));
	World.Store.Refresh();
	World.Gather.Count(World.Store, FCullingRule(glm::dvec3(205, 0, 200), Settings));
	EXPECT_TRUE(World.Gather.HasChanged()) << "an object was written";
}

TEST(GatherStore, TheOrderOfInstancesDoesNotDependOnThreads)
{
	std::vector<FRTInstance> First;
	for (int Try = 0; Try < 4; ++Try)
	{
		FRandom Random(9);
		FGatherWorld World;
		World.Store.SetBinding(0, {64, 0});
		for (uint32_t I = 0; I < 30000; ++I) { World.Set(I, PlaceAt(RandomPlace(Random, 2000, {}), std::abs(RandomRadius(Random)))); }
		World.Store.Refresh();
		const uint32_t Count = World.Gather.Count(World.Store, FCullingRule({}, {}));
		FInstanceArray Out(Count);
		World.Gather.Write(World.Store, {0, 0, 0}, Out.Get());
		std::vector<FRTInstance> Now(Out.Get(), Out.Get() + Count);
		if (Try == 0) { First = Now; }
		ASSERT_EQ(First.size(), Now.size());
		EXPECT_EQ(std::memcmp(First.data(), Now.data(), Now.size() * sizeof(FRTInstance)), 0);
	}
}

TEST(GatherStore, BucketsStayFullEnoughWhileTheWorldStreams)
{
	// Objects enter ahead and leave behind; what is left of old places must not pile up.
	FGatherWorld World;
	World.Store.SetBinding(0, {64, 0});
	FRandom Random(5);
	constexpr uint32_t Most = 4000;
	size_t MostBuckets = 0;
	for (uint32_t Step = 0; Step < 40000; ++Step)
	{
		const double Ahead = 0.5 * Step;
		World.Set(Step % Most, PlaceAt({Ahead + Uniform(Random, 0, 500), 0, Uniform(Random, -500, 500)}, 2.0));
		if (Step == 2 * Most) { MostBuckets = World.Store.GetBucketCapacity(); }
		if (Step % 1000 == 0) { World.Store.Refresh(); }
	}
	World.Store.Refresh();
	ASSERT_NO_FATAL_FAILURE(ExpectConsistent(World.Store));
	EXPECT_LE(World.Store.GetBucketCapacity(), 2 * MostBuckets);
	EXPECT_LE(World.Store.GetBucketCount(), Most / 10);
}

TEST(GatherCulling, SidesGroupsAndSizesDecideAsTheySay)
{
	FCullingSettings Settings;
	Settings.Radius = 100;
	Settings.RadiusBehind = 50;
	Settings.Angle = Settings.AngleBehind = 10;
	const FCullingRule Rule(FGatherView({0, 0, 0}, {0, 0, -1}, 1.0f, 1000), Settings);
	EXPECT_NE(Rule.Test({0, 0, -101.9}, 2), 0) << "its near side is within the radius";
	EXPECT_EQ(Rule.Test({0, 0, -102.1}, 2), 0);
	EXPECT_NE(Rule.Test({0, 0, 51.9}, 2), 0);
	EXPECT_EQ(Rule.Test({0, 0, 52.1}, 2), 0);
	EXPECT_NE(Rule.Test({0, 0, 1.9}, 2), 0);
	const double Sine = std::sin(glm::radians(10.0));
	EXPECT_NE(Rule.Test({0, 0, -999}, 1000 * Sine), 0) << "large enough";
	EXPECT_EQ(Rule.Test({0, 0, -1001}, 1000 * Sine), 0);
	EXPECT_NE(Rule.Test({1e7, 0, 1e7}, UnboundedRadius), 0);
	Settings.ShadowMinPixels = 24;
	Settings.VisibleMinPixels = 4;
	const FCullingRule Pixels(FGatherView({0, 0, 0}, {0, 0, -1}, 1.0f, 1000), Settings);
	// Diameter 2r at distance d covers 1000 · r / (d · tan ½) pixels.
	const double R = 0.5, PerPixel = 1000.0 * R / std::tan(0.5);
	EXPECT_EQ(Pixels.Test({0, 0, -PerPixel / 24.1}, R), 0xff);
	EXPECT_EQ(Pixels.Test({0, 0, -PerPixel / 23.9}, R), 0xff & ~MASK_CASTERS);
	EXPECT_NEAR(Pixels.ScreenSize({0, 0, -50}, R), PerPixel / 50, 0.01);
	Settings = {};
	Settings.Radius = 1e6f;
	Settings.VisibleMinPixels = 4;
	const FCullingRule Visible(FGatherView({0, 0, 0}, {0, 0, -1}, 1.0f, 1000), Settings);
	EXPECT_EQ(Visible.Test({0, 0, -PerPixel / 3.9}, R), MASK_CASTERS);
}

} // namespace
} // namespace Lantern
