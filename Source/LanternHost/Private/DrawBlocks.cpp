// Sorts draws into blocks of nearby objects and culls them against a view.
#include "LanternHost/DrawBlocks.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "LanternCore/Tasks/TaskTrace.h"
#include "LanternCore/Tasks/Tasks.h"

namespace Lantern
{

namespace
{
constexpr size_t BlockGrain = 256;
/// Number of blocks whose bounds are recomputed in a frame. All take turns, so that moving objects do not keep bounds large.
constexpr size_t RefreshedBlocks = 32;

/// Returns the position along a Z curve over the ground. Infinite spheres come last.
uint64_t GetPlaceKey(const FDrawSphere& Sphere, const glm::dvec3& Min, double Scale)
{
	if (!std::isfinite(Sphere.Radius)) { return ~0ull; }
	const glm::dvec3 At = glm::clamp((Sphere.Center - Min) * Scale, 0.0, 1048575.0);
	uint64_t Key = 0;
	for (int Bit = 0; Bit < 20; ++Bit)
	{
		for (int Axis = 0; Axis < 3; ++Axis) { Key |= ((uint64_t(At[Axis]) >> Bit) & 1u) << (3 * Bit + Axis); }
	}
	return Key;
}
} // namespace

/// FViewFrustum in fp32, for points relative to the camera.
struct FDrawBlocks::FFrustum
{
	glm::dvec3 Eye;
	glm::vec3 AxisX, AxisY, Forward;
	float Near, ScaleX, SlopeX, HalfX, ScaleY, SlopeY, HalfY;
	float SizePerDistance2 = 0.0f; // of a radius squared, by distance squared: smaller is too small
	float LeastSize2 = 0.0f;       // of a radius squared, at any distance

	FFrustum(const FView& View, float MinPixels) : FFrustum(FViewFrustum(View))
	{
		const double RadiusPerDistance = 0.5 * double(MinPixels) * View.GetPixelSize();
		(View.GetWindow().bOrthographic ? LeastSize2 : SizePerDistance2) = float(RadiusPerDistance * RadiusPerDistance);
	}

private:
	explicit FFrustum(const FViewFrustum& From)
	    : Eye(From.Eye),
	      AxisX(From.X.Axis),
	      AxisY(From.Y.Axis),
	      Forward(From.Forward),
	      Near(float(From.Near)),
	      ScaleX(float(From.X.Scale)),
	      SlopeX(float(From.X.Slope)),
	      HalfX(float(From.X.Half)),
	      ScaleY(float(From.Y.Scale)),
	      SlopeY(float(From.Y.Slope)),
	      HalfY(float(From.Y.Half))
	{}
};

void FDrawBlocks::Build(const std::vector<FItem>& Items, const std::vector<FDrawSphere>& Spheres)
{
	glm::dvec3 Min(std::numeric_limits<double>::max()), Max(-Min);
	for (const FDrawSphere& Sphere : Spheres)
	{
		Min = glm::min(Min, Sphere.Center);
		Max = glm::max(Max, Sphere.Center);
	}
	const glm::dvec3 Size = Max - Min;
	const double Scale = 1048575.0 / std::max({Size.x, Size.y, Size.z, 1e-3});
	std::vector<std::pair<uint64_t, uint32_t>> Order(Items.size());
	for (uint32_t Draw = 0; Draw < Order.size(); ++Draw) { Order[Draw] = {GetPlaceKey(Spheres[Draw], Min, Scale), Draw}; }
	std::sort(Order.begin(), Order.end());
	Places.resize(Items.size());
	Blocks.clear();
	Bounds.clear();
	NextStale = 0;
	Stale.clear();
	bMirrored = false;
	for (size_t First = 0; First < Order.size();)
	{
		FBlock& Block = Blocks.emplace_back();
		Block.Center = Spheres[Order[First].second].Center;
		Bounds.push_back({Block.Center});
		// Infinite spheres have blocks of their own, so that they do not make the bounds of others infinite.
		const bool bInfinite = Order[First].first == ~0ull;
		for (; First < Order.size() && Block.Count < FBlock::Capacity && (Order[First].first == ~0ull) == bInfinite; ++First)
		{
			const uint32_t Draw = Order[First].second;
			Places[Draw] = uint32_t(Blocks.size() - 1) * FBlock::Capacity + Block.Count;
			Block.Items[Block.Count++] = Items[Draw];
		}
	}
	for (uint32_t Draw = 0; Draw < Spheres.size(); ++Draw) { Move(Draw, Spheres[Draw]); }
}

void FDrawBlocks::Move(uint32_t Draw, const FDrawSphere& Sphere)
{
	const uint32_t Index = Places[Draw] / FBlock::Capacity, Item = Places[Draw] % FBlock::Capacity;
	FBlock& Block = Blocks[Index];
	const glm::vec3 Relative(Sphere.Center - Block.Center);
	Block.X[Item] = Relative.x;
	Block.Y[Item] = Relative.y;
	Block.Z[Item] = Relative.z;
	Block.R[Item] = float(Sphere.Radius);
	Block.Mirrored = (Block.Mirrored & ~(1ull << Item)) | (uint64_t(Sphere.bMirrored) << Item);
	FBounds& Of = Bounds[Index];
	bMirrored |= Sphere.bMirrored;
	Of.Radius = std::max(Of.Radius, glm::length(Relative) + Block.R[Item]);
	if (!std::exchange(Of.bStale, true)) { Stale.push_back(Index); }
}

void FDrawBlocks::Refresh(uint32_t Index)
{
	const FBlock& Block = Blocks[Index];
	float Radius = 0.0f;
	for (uint32_t I = 0; I < Block.Count; ++I)
	{
		const float Reach = std::sqrt(Block.X[I] * Block.X[I] + Block.Y[I] * Block.Y[I] + Block.Z[I] * Block.Z[I]) + Block.R[I];
		Radius = std::max(Radius, Reach);
	}
	Bounds[Index].Radius = Radius;
	Bounds[Index].bStale = false;
}

void FDrawBlocks::AddExtent(const glm::dvec3& Axis, double& Min, double& Max) const
{
	for (const FBounds& Of : Bounds)
	{
		if (!std::isfinite(Of.Radius)) { continue; }
		Min = std::min(Min, glm::dot(Of.Center, Axis) - double(Of.Radius));
		Max = std::max(Max, glm::dot(Of.Center, Axis) + double(Of.Radius));
	}
}

bool FDrawBlocks::MaySeeBlock(const FFrustum& F, const FBounds& Block)
{
	const glm::vec3 D(Block.Center - F.Eye);
	const float Reach = Block.Radius * 1.00001f + 1e-5f * (std::abs(D.x) + std::abs(D.y) + std::abs(D.z));
	const float Z = glm::dot(D, F.Forward);
	return Z + Reach >= F.Near && std::abs(glm::dot(D, F.AxisX)) * F.ScaleX - Z * F.SlopeX - F.HalfX <= Reach &&
	       std::abs(glm::dot(D, F.AxisY)) * F.ScaleY - Z * F.SlopeY - F.HalfY <= Reach;
}

uint64_t FDrawBlocks::CullItems(const FFrustum& F, const FBlock& Block)
{
	const glm::vec3 D(Block.Center - F.Eye);
	// Conservative: rounding must not cull anything that the view sees.
	const float Slack = 1e-5f * (std::abs(D.x) + std::abs(D.y) + std::abs(D.z)) + 1e-4f;
	uint8_t bSeen[FBlock::Capacity];
	for (uint32_t I = 0; I < FBlock::Capacity; ++I)
	{
		const float X = D.x + Block.X[I], Y = D.y + Block.Y[I], Z = D.z + Block.Z[I], R = Block.R[I] + Slack;
		const float Ahead = X * F.Forward.x + Y * F.Forward.y + Z * F.Forward.z;
		const float Aside = std::abs(X * F.AxisX.x + Y * F.AxisX.y + Z * F.AxisX.z);
		const float Above = std::abs(X * F.AxisY.x + Y * F.AxisY.y + Z * F.AxisY.z);
		const float Distance2 = X * X + Y * Y + Z * Z;
		bSeen[I] =
		    uint8_t(int(Ahead + R >= F.Near) & int(Aside * F.ScaleX - Ahead * F.SlopeX - F.HalfX <= R) &
		            int(Above * F.ScaleY - Ahead * F.SlopeY - F.HalfY <= R) & int(R * R >= F.SizePerDistance2 * Distance2 + F.LeastSize2));
	}
	uint64_t Mask = 0;
	for (uint32_t I = 0; I < Block.Count; ++I) { Mask |= uint64_t(bSeen[I]) << I; }
	return Mask;
}

void FDrawBlocks::Collect(const FView& View, float MinPixels, std::vector<FSeen>& Out)
{
	FTraceScope Trace("G-buffer culling");
	const FFrustum Frustum(View, MinPixels);
	for (size_t I = 0; I < RefreshedBlocks && NextStale < Stale.size(); ++I) { Refresh(Stale[NextStale++]); }
	if (NextStale == Stale.size() || NextStale >= Bounds.size())
	{
		Stale.erase(Stale.begin(), Stale.begin() + static_cast<ptrdiff_t>(NextStale));
		NextStale = 0;
	}
	Out.clear();
	for (uint32_t Index = 0; Index < Bounds.size(); ++Index)
	{
		if (MaySeeBlock(Frustum, Bounds[Index])) { Out.push_back({Index, float(glm::distance(Bounds[Index].Center, View.Position)), 0}); }
	}
	std::sort(Out.begin(), Out.end(),
	    [](const FSeen& A, const FSeen& B) { return A.Distance != B.Distance ? A.Distance < B.Distance : A.Block < B.Block; });
	ParallelFor(Out.size(), BlockGrain, [&](size_t Begin, size_t End) {
		for (size_t I = Begin; I < End; ++I) { Out[I].Items = CullItems(Frustum, Blocks[Out[I].Block]); }
	});
	std::erase_if(Out, [](const FSeen& Seen) { return Seen.Items == 0; });
}

} // namespace Lantern
