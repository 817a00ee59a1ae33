// The raster's culling: nothing that the view sees is left out, and most of what it does not see is.
#include <cmath>
#include <limits>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "LanternHost/DrawBlocks.h"

namespace Lantern
{
namespace
{

class FDrawBlocksTest : public ::testing::Test
{
protected:
	double Uniform(double Min, double Max) { return std::uniform_real_distribution<double>(Min, Max)(Random); }
	FDrawSphere MakeSphere(const glm::dvec3& Around, double Extent)
	{
		FDrawSphere Sphere;
		Sphere.Center = Around + glm::dvec3(Uniform(-Extent, Extent), Uniform(-50, 50), Uniform(-Extent, Extent));
		Sphere.Radius = std::exp(Uniform(-3, 4));
		Sphere.bMirrored = Random() % 2 != 0;
		return Sphere;
	}
	void Build(size_t Count, const glm::dvec3& Around, double Extent)
	{
		std::vector<FDrawBlocks::FItem> Items;
		for (uint32_t I = 0; I < Count; ++I)
		{
			Spheres.push_back(MakeSphere(Around, Extent));
			if (I % 97 == 5) { Spheres.back().Radius = std::numeric_limits<double>::infinity(); }
			Items.push_back({I, 2 * I, 3});
		}
		Blocks.Build(Items, Spheres);
	}
	/// Objects that Collect keeps; each once, as they are.
	std::vector<bool> Collect(const FView& View, float MinPixels = 0.0f)
	{
		std::vector<FDrawBlocks::FSeen> Seen;
		Blocks.Collect(View, MinPixels, Seen);
		std::vector<bool> Kept(Spheres.size());
		float Before = 0.0f;
		for (const FDrawBlocks::FSeen& InBlock : Seen)
		{
			EXPECT_GE(InBlock.Distance, Before);
			Before = InBlock.Distance;
			const FDrawBlocks::FBlock& Block = Blocks.GetBlock(InBlock.Block);
			for (uint32_t I = 0; I < FDrawBlocks::FBlock::Capacity; ++I)
			{
				if (((InBlock.Items >> I) & 1u) == 0) { continue; }
				const FDrawBlocks::FItem& Item = Block.Items[I];
				EXPECT_FALSE(Kept.at(Item.Object)) << "twice";
				Kept.at(Item.Object) = true;
				EXPECT_EQ(Item.FirstBatch, 2 * Item.Object);
				EXPECT_EQ(Item.BatchCount, 3u);
				EXPECT_EQ((Block.Mirrored >> I) & 1u, uint64_t(Spheres[Item.Object].bMirrored));
			}
		}
		return Kept;
	}
	FView MakeView(const glm::dvec3& Around, double Extent)
	{
		const glm::dvec3 Position = Around + glm::dvec3(Uniform(-Extent, Extent), Uniform(-20, 20), Uniform(-Extent, Extent));
		const glm::dvec3 Target = Position + glm::dvec3(Uniform(-1, 1), Uniform(-0.5, 0.5), Uniform(-1, 1));
		return LookAt(Position, Target, float(Uniform(0.2, 1.8)), 100 + Random() % 1000, 100 + Random() % 1000);
	}
	/// A little larger or smaller than the sphere is: what lies between may go either way.
	static bool MaySee(const FView& View, const FDrawSphere& Sphere, double Tolerance)
	{
		return FViewFrustum(View).MaySee(Sphere.Center, Sphere.Radius + Tolerance);
	}
	void Check(const FView& View)
	{
		const std::vector<bool> Kept = Collect(View);
		for (size_t I = 0; I < Spheres.size(); ++I)
		{
			if (Kept[I]) { EXPECT_TRUE(MaySee(View, Spheres[I], 0.5)) << I; }
			else { EXPECT_FALSE(MaySee(View, Spheres[I], 0.0)) << I; }
		}
	}

	std::mt19937 Random{11};
	std::vector<FDrawSphere> Spheres;
	FDrawBlocks Blocks;
};

TEST_F(FDrawBlocksTest, KeepsWhatTheViewSees)
{
	Build(5000, {0, 0, 0}, 2000);
	for (int I = 0; I < 50; ++I) { Check(MakeView({0, 0, 0}, 2000)); }
}

TEST_F(FDrawBlocksTest, FarFromTheOriginAndAfterMoves)
{
	const glm::dvec3 Far(16'000, 300, -16'000);
	Build(3000, Far, 1000);
	for (int I = 0; I < 50; ++I)
	{
		for (int Move = 0; Move < 100; ++Move)
		{
			const uint32_t Draw = Random() % Spheres.size();
			Spheres[Draw] = MakeSphere(Far, 3000); // also out of its block
			Blocks.Move(Draw, Spheres[Draw]);
		}
		Check(MakeView(Far, 1000));
	}
}

TEST_F(FDrawBlocksTest, SmallOnTheScreenIsLeftOut)
{
	Build(4000, {0, 0, 0}, 3000);
	for (int Round = 0; Round < 20; ++Round)
	{
		const FView View = MakeView({0, 0, 0}, 3000);
		const std::vector<bool> All = Collect(View), Large = Collect(View, 4.0f);
		for (size_t I = 0; I < Spheres.size(); ++I)
		{
			const double Distance = glm::distance(Spheres[I].Center, View.Position);
			const double Pixels = Spheres[I].Radius / Distance / std::tan(0.5 * View.FovY) * View.Height;
			if (Large[I]) { EXPECT_TRUE(All[I] && Pixels > 3.9) << Pixels; }
			else { EXPECT_TRUE(!All[I] || Pixels < 4.1) << Pixels; }
		}
	}
}

TEST_F(FDrawBlocksTest, NothingIsNothing)
{
	Build(0, {0, 0, 0}, 1);
	EXPECT_TRUE(Collect(MakeView({0, 0, 0}, 1)).empty());
}

} // namespace
} // namespace Lantern
