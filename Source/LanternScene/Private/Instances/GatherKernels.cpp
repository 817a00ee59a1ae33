// The inner loops of gathering, and the choice between their AVX2 and plain builds.
#include "Instances/GatherKernels.h"

#include <algorithm>
#include <cmath>
#include <cstring>

// Kernels are compiled twice. The processor decides at run time which is called.
#if (defined(__x86_64__) || defined(__i386__)) && defined(__GNUC__)
#define LANTERN_KERNEL_AVX2 __attribute__((target("avx2,fma")))
#define LANTERN_KERNEL_INLINE inline __attribute__((always_inline))
#else
#define LANTERN_KERNEL_INLINE inline
#endif

namespace Lantern
{

namespace
{
constexpr uint32_t Capacity = FInstanceBucket::Capacity;
/// Error of a difference of fp32 coordinates, relative to the larger of the two: three roundings, and those of the squares.
constexpr float PlaceError = 1e-6f;
constexpr float SquareError = 4e-6f;

LANTERN_KERNEL_INLINE float Larger(float A, float B) { return A > B ? A : B; }
LANTERN_KERNEL_INLINE float Smaller(float A, float B) { return A < B ? A : B; }
/// Rounds up to whole vectors, so that loops need no remainder.
LANTERN_KERNEL_INLINE uint32_t RoundUp(uint32_t Count) { return (Count + 15) & ~15u; }
LANTERN_KERNEL_INLINE float Square(float A) { return A * A; }

LANTERN_KERNEL_INLINE void ClassifyLoop(const float* __restrict X, const float* __restrict Y, const float* __restrict Z,
    const float* __restrict Extent, const float* __restrict RMin, const float* __restrict RMax, size_t Count, const FKernelRule& InRule,
    uint32_t* __restrict Out)
{
	const FKernelRule Rule = InRule;
	const float EyeSize = std::fabs(Rule.Eye[0]) + std::fabs(Rule.Eye[1]) + std::fabs(Rule.Eye[2]);
	for (size_t I = 0; I < Count; ++I)
	{
		const float DX = X[I] - Rule.Eye[0], DY = Y[I] - Rule.Eye[1], DZ = Z[I] - Rule.Eye[2];
		const float D2 = DX * DX + DY * DY + DZ * DZ;
		const float Ahead = DX * Rule.Forward[0] + DY * Rule.Forward[1] + DZ * Rule.Forward[2];
		const float Reach = Extent[I] + PlaceError * (EyeSize + std::fabs(X[I]) + std::fabs(Y[I]) + std::fabs(Z[I]));
		const float MostBefore = Larger(Rule.Radius[0] + RMax[I], RMax[I] * Rule.InverseSine[0]);
		const float MostBehind = Larger(Rule.Radius[1] + RMax[I], RMax[I] * Rule.InverseSine[1]);
		const float LeastBefore = Larger(Rule.Radius[0] + RMin[I], RMin[I] * Rule.InverseSine[0]);
		const float LeastBehind = Larger(Rule.Radius[1] + RMin[I], RMin[I] * Rule.InverseSine[1]);
		const bool bAllBehind = Ahead + Reach<-RMax[I], bAllAhead = Ahead - Reach> - RMin[I];
		const float FarBoth = Larger(MostBefore, MostBehind), NearBoth = Smaller(LeastBefore, LeastBehind);
		const float FarAhead = bAllAhead ? MostBefore : FarBoth, NearAhead = bAllAhead ? LeastBefore : NearBoth;
		const float Far = bAllBehind ? MostBehind : FarAhead, Near = bAllBehind ? LeastBehind : NearAhead;
		// The far end of the bucket is within L if D ≤ L − Reach. The near end is beyond L if D > L + Reach.
		const float OthersNear = Smaller(Near, RMin[I] * Rule.VisibleScale + Rule.VisibleBase) * (1 - PlaceError) - Reach;
		const float ShadowNear = Smaller(Near, RMin[I] * Rule.ShadowScale + Rule.ShadowBase) * (1 - PlaceError) - Reach;
		const float OthersFar = Smaller(Far, RMax[I] * Rule.VisibleScale + Rule.VisibleBase) * (1 + PlaceError) + Reach;
		const float ShadowFar = Smaller(Far, RMax[I] * Rule.ShadowScale + Rule.ShadowBase) * (1 + PlaceError) + Reach;
		const float Above = D2 * (1 + SquareError), Below = D2 * (1 - SquareError);
		// A limit below 0 is never met, but its square could be. The sign is kept.
		const float OthersNear2 = OthersNear * std::fabs(OthersNear), ShadowNear2 = ShadowNear * std::fabs(ShadowNear);
		const uint32_t AllOthers = Above <= OthersNear2 ? BucketAllOthers : 0u;
		const uint32_t AllShadow = Above <= ShadowNear2 ? BucketAllShadow : 0u;
		const uint32_t NoOthers = Below > Square(OthersFar) ? BucketNoOthers : 0u;
		const uint32_t NoShadow = Below > Square(ShadowFar) ? BucketNoShadow : 0u;
		Out[I] = AllOthers | AllShadow | NoOthers | NoShadow;
	}
}

constexpr uint32_t FlagOthers = 1, FlagShadow = 2, FlagUnsure = 4;

/// Margin bounds the error of a squared distance. Reach bounds the error of a distance along an axis.
LANTERN_KERNEL_INLINE void TestLoop(
    const FInstanceBucket& Bucket, const FKernelRule& InRule, float Margin, float Reach, uint32_t* __restrict Out)
{
	const FKernelRule Rule = InRule;
	const uint32_t Count = RoundUp(Bucket.Count);
	for (uint32_t I = 0; I < Count; ++I)
	{
		const float R = Bucket.R[I];
		const float DX = Bucket.X[I] - Rule.Eye[0], DY = Bucket.Y[I] - Rule.Eye[1], DZ = Bucket.Z[I] - Rule.Eye[2];
		const float D2 = DX * DX + DY * DY + DZ * DZ;
		const float Ahead = DX * Rule.Forward[0] + DY * Rule.Forward[1] + DZ * Rule.Forward[2];
		const float Before = Square(Larger(Rule.Radius[0] + R, R * Rule.InverseSine[0]));
		const float Behind = Square(Larger(Rule.Radius[1] + R, R * Rule.InverseSine[1]));
		const bool bSurelyBehind = Ahead + Reach<-R, bSurelyBefore = Ahead - Reach> - R;
		const float LeastBoth = Smaller(Before, Behind), MostBoth = Larger(Before, Behind);
		const float LeastBefore = bSurelyBefore ? Before : LeastBoth, MostBefore = bSurelyBefore ? Before : MostBoth;
		const float Least = bSurelyBehind ? Behind : LeastBefore, Most = bSurelyBehind ? Behind : MostBefore;
		const float Others = Square(R * Rule.VisibleScale + Rule.VisibleBase), Shadow = Square(R * Rule.ShadowScale + Rule.ShadowBase);
		const float Above = D2 + Margin, Below = D2 - Margin;
		const uint32_t Kept = Above <= Least ? 1u : 0u, Dropped = Below > Most ? 1u : 0u;
		const uint32_t OthersKept = Above <= Others ? 1u : 0u, OthersDropped = Below > Others ? 1u : 0u;
		const uint32_t ShadowKept = Above <= Shadow ? 1u : 0u, ShadowDropped = Below > Shadow ? 1u : 0u;
		// An object is sure if it is left out altogether, or is kept and both limits on the screen are decided.
		const uint32_t Sure = Dropped | (Kept & (OthersKept | OthersDropped) & (ShadowKept | ShadowDropped));
		Out[I] = (Kept & OthersKept) * FlagOthers | (Kept & ShadowKept) * FlagShadow | (Sure ^ 1u) * FlagUnsure;
	}
}

LANTERN_KERNEL_INLINE void PackLoop(const uint32_t* __restrict Flags, uint32_t Count, uint8_t* __restrict Bytes)
{
	for (uint32_t I = 0; I < Count; ++I) { Bytes[I] = static_cast<uint8_t>(Flags[I]); }
}

#ifdef LANTERN_KERNEL_AVX2
LANTERN_KERNEL_AVX2 void ClassifyAvx2(const FBucketBounds& B, size_t First, size_t Count, const FKernelRule& Rule, uint32_t* Out)
{
	ClassifyLoop(&B.X[First], &B.Y[First], &B.Z[First], &B.Extent[First], &B.RMin[First], &B.RMax[First], Count, Rule, Out);
}
LANTERN_KERNEL_AVX2 void TestAvx2(const FInstanceBucket& Bucket, const FKernelRule& Rule, float Margin, float Reach, uint8_t* Out)
{
	alignas(64) uint32_t Flags[Capacity];
	TestLoop(Bucket, Rule, Margin, Reach, Flags);
	PackLoop(Flags, RoundUp(Bucket.Count), Out);
}
const bool bHasAvx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#endif

void ClassifyPlain(const FBucketBounds& B, size_t First, size_t Count, const FKernelRule& Rule, uint32_t* Out)
{
	ClassifyLoop(&B.X[First], &B.Y[First], &B.Z[First], &B.Extent[First], &B.RMin[First], &B.RMax[First], Count, Rule, Out);
}
void TestPlain(const FInstanceBucket& Bucket, const FKernelRule& Rule, float Margin, float Reach, uint8_t* Out)
{
	alignas(64) uint32_t Flags[Capacity];
	TestLoop(Bucket, Rule, Margin, Reach, Flags);
	PackLoop(Flags, RoundUp(Bucket.Count), Out);
}

/// Collects bit Shift of each of Count bytes.
uint64_t CollectBits(const uint8_t* Bytes, uint32_t Count, uint32_t Shift)
{
	uint64_t Mask = 0;
	for (uint32_t Group = 0; Group < RoundUp(Count) / 8; ++Group)
	{
		uint64_t Eight;
		std::memcpy(&Eight, Bytes + 8 * Group, sizeof(Eight));
		Eight = (Eight >> Shift) & 0x0101010101010101ull;
		// The product's top byte gathers the lowest bit of each byte (first byte lowest on little-endian machines).
		Mask |= ((Eight * 0x0102040810204080ull) >> 56) << (8 * Group);
	}
	return Mask;
}
} // namespace

void ClassifyBuckets(const FBucketBounds& Bounds, size_t First, size_t Count, const FKernelRule& Rule, uint32_t* OutClass)
{
#ifdef LANTERN_KERNEL_AVX2
	if (bHasAvx2) { return ClassifyAvx2(Bounds, First, Count, Rule, OutClass); }
#endif
	ClassifyPlain(Bounds, First, Count, Rule, OutClass);
}

FBucketMasks TestBucket(const FInstanceBucket& Bucket, const FKernelRule& Rule, float BucketExtent)
{
	const float Size = BucketExtent + std::fabs(Rule.Eye[0]) + std::fabs(Rule.Eye[1]) + std::fabs(Rule.Eye[2]);
	alignas(64) uint8_t Flags[Capacity];
#ifdef LANTERN_KERNEL_AVX2
	if (bHasAvx2) { TestAvx2(Bucket, Rule, SquareError * Size * Size, PlaceError * Size, Flags); }
	else
#endif
	{
		TestPlain(Bucket, Rule, SquareError * Size * Size, PlaceError * Size, Flags);
	}
	return {CollectBits(Flags, Bucket.Count, 0), CollectBits(Flags, Bucket.Count, 1), CollectBits(Flags, Bucket.Count, 2)};
}

} // namespace Lantern
