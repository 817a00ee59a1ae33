// FInstanceGather: counts and writes blocks of buckets in parallel.
#include "LanternScene/Instances/Gather.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <utility>

#include "Instances/GatherKernels.h"
#include "LanternCore/Tasks/Tasks.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace Lantern
{

namespace
{
constexpr size_t BlockBuckets = 64;

FKernelRule MakeKernelRule(const FCullingRule& Rule, const glm::dvec3& Center)
{
	constexpr float NoLimit = 1e18f; // fp32 holds its square
	FKernelRule Out;
	const glm::dvec3 Eye = Rule.Eye - Center;
	for (int Axis = 0; Axis < 3; ++Axis)
	{
		Out.Eye[Axis] = static_cast<float>(Eye[Axis]);
		Out.Forward[Axis] = static_cast<float>(Rule.Forward[Axis]);
	}
	for (int Side = 0; Side < 2; ++Side)
	{
		Out.Radius[Side] = static_cast<float>(Rule.Radius[Side]);
		Out.InverseSine[Side] = static_cast<float>(Rule.InverseSine[Side]);
	}
	Out.VisibleScale = Rule.bVisibleLimit ? static_cast<float>(Rule.VisibleScale) : 0.0f;
	Out.VisibleBase = Rule.bVisibleLimit ? 0.0f : NoLimit;
	Out.ShadowScale = Rule.bShadowLimit ? static_cast<float>(Rule.ShadowScale) : 0.0f;
	Out.ShadowBase = Rule.bShadowLimit ? 0.0f : NoLimit;
	return Out;
}

/// Puts an instance together in registers and stores it at once: the memory may be write-combined.
inline void WriteInstance(
    FRTInstance* Out, const float* Transform, const glm::vec3& Offset, uint32_t IndexAndMask, const FInstanceBinding& Binding)
{
	const uint64_t Words[2] = {(IndexAndMask & Binding.MaskBits) | (uint64_t(Binding.TableOffsetAndFlags) << 32), Binding.GeometryAddress};
#if defined(__SSE2__)
	float* const To = reinterpret_cast<float*>(Out);
	for (int Row = 0; Row < 3; ++Row)
	{
		// Adding −0 changes nothing, not even the sign of −0.
		const __m128 Add = _mm_set_ps(Offset[Row], -0.0f, -0.0f, -0.0f);
		_mm_stream_ps(To + 4 * Row, _mm_add_ps(_mm_load_ps(Transform + 4 * Row), Add));
	}
	_mm_stream_si128(
	    reinterpret_cast<__m128i*>(To + 12), _mm_set_epi64x(static_cast<long long>(Words[1]), static_cast<long long>(Words[0])));
#else
	FRTInstance Value;
	std::memcpy(Value.Transform, Transform, sizeof(Value.Transform));
	for (int Row = 0; Row < 3; ++Row) { Value.Transform[4 * Row + 3] += Offset[Row]; }
	std::memcpy(&Value.CustomIndexAndMask, Words, sizeof(Words));
	std::memcpy(Out, &Value, sizeof(Value));
#endif
}

inline uint32_t MaskBits(bool bOthers, bool bShadow)
{
	return 0xffffffu | (bOthers ? uint32_t(0xff & ~MASK_CASTERS) << 24 : 0u) | (bShadow ? uint32_t(MASK_CASTERS) << 24 : 0u);
}
} // namespace

struct FInstanceGather::FPass
{
	const FInstanceStore& Store;
	const FCullingRule& Rule;
	FKernelRule World;
	const FMissingGeometrySink& Missing;
	bool bDropMissing = false;
};

FInstanceGather::FKept FInstanceGather::CullBucket(const FPass& Pass, size_t Index, uint32_t Class) const
{
	const FInstanceBucket& Bucket = *Pass.Store.GetBucket(Index);
	const uint64_t Used = Bucket.Used();
	FKept Out;
	if (!Pass.Rule.bCull) { Out.Others = Out.Shadow = Used; }
	else if (Bucket.Group > 0)
	{
		const uint8_t Bits = GroupBits[Bucket.Group];
		Out.Others = (Bits & ~MASK_CASTERS) ? Used : 0;
		Out.Shadow = (Bits & MASK_CASTERS) ? Used : 0;
	}
	else if ((Class & (BucketAllOthers | BucketNoOthers)) && (Class & (BucketAllShadow | BucketNoShadow)))
	{
		Out.Others = (Class & BucketAllOthers) ? Used : 0;
		Out.Shadow = (Class & BucketAllShadow) ? Used : 0;
	}
	else
	{
		const FBucketBounds& Bounds = Pass.Store.GetBounds();
		const glm::dvec3 Cell = CellCenter(Bucket.Cell);
		const glm::dvec3 Away = glm::dvec3(Bounds.X[Index], Bounds.Y[Index], Bounds.Z[Index]) - Cell;
		const float Extent = Bounds.Extent[Index] + static_cast<float>(std::abs(Away.x) + std::abs(Away.y) + std::abs(Away.z));
		const FBucketMasks Masks = TestBucket(Bucket, MakeKernelRule(Pass.Rule, Cell), Extent);
		Out.Others = Masks.Others & Used & ~Masks.Unsure;
		Out.Shadow = Masks.Shadow & Used & ~Masks.Unsure;
		// If fp32 cannot tell, fp64 decides, by the rule that holds everywhere else.
		for (uint64_t Left = Masks.Unsure & Used; Left != 0; Left &= Left - 1)
		{
			const FInstanceRecord& Record = Pass.Store.GetRecord(Bucket.Object(static_cast<uint32_t>(std::countr_zero(Left))));
			const uint8_t Bits = Pass.Rule.Test(Record.Center, Record.Radius);
			Out.Others |= (Bits & ~MASK_CASTERS) ? Left & (~Left + 1) : 0;
			Out.Shadow |= (Bits & MASK_CASTERS) ? Left & (~Left + 1) : 0;
		}
	}
	Out.Written = (Out.Others & Bucket.SeenByOthers) | (Out.Shadow & Bucket.SeenByShadow);
	if (Pass.bDropMissing && Out.Written != 0) { Out.Written = DropMissing(Pass, Bucket, Out.Written); }
	return Out;
}

uint64_t FInstanceGather::DropMissing(const FPass& Pass, const FInstanceBucket& Bucket, uint64_t Left) const
{
	uint64_t There = Left;
	uint32_t Told = ~0u;
	for (; Left != 0; Left &= Left - 1)
	{
		const auto Lane = static_cast<uint32_t>(std::countr_zero(Left));
		const FInstanceBinding& Binding = Pass.Store.GetBinding(Bucket.Range[Lane]);
		if (Binding.GeometryAddress != 0) { continue; }
		There &= ~(1ull << Lane);
		if (Binding.GeometrySlot == Told || Binding.GeometrySlot == ~0u || !Pass.Missing) { continue; }
		Told = Binding.GeometrySlot;
		const FInstanceRecord& Record = Pass.Store.GetRecord(Bucket.Object(Lane));
		Pass.Missing(Told, Pass.Rule.ScreenSize(Record.Center, Record.Radius));
	}
	return There;
}

uint32_t FInstanceGather::CountBlock(const FPass& Pass, size_t Block, bool& OutChanged)
{
	const size_t First = Block * BlockBuckets, Buckets = std::min(BlockBuckets, Pass.Store.GetBucketCapacity() - First);
	uint32_t Classes[BlockBuckets] = {};
	if (Pass.Rule.bCull) { ClassifyBuckets(Pass.Store.GetBounds(), First, Buckets, Pass.World, Classes); }
	const bool bNoGroups = Pass.Store.GetGroups().size() == 1;
	uint32_t Found = 0;
	for (size_t I = 0; I < Buckets; ++I)
	{
		FKept& Old = Kept[First + I];
		FKept New;
		// Most of a large world is culled without reading the bucket. Buckets of groups must be read: the group decides.
		const bool bGone = bNoGroups && Classes[I] == (BucketNoOthers | BucketNoShadow);
		if (!bGone && Pass.Store.GetBucket(First + I)) { New = CullBucket(Pass, First + I, Classes[I]); }
		Found += static_cast<uint32_t>(std::popcount(New.Written));
		OutChanged |= !(New == Old);
		Old = New;
	}
	return Found;
}

uint32_t FInstanceGather::Count(const FInstanceStore& Store, const FCullingRule& Rule, const FMissingGeometrySink& Missing)
{
	const size_t Buckets = Store.GetBucketCapacity(), Blocks = (Buckets + BlockBuckets - 1) / BlockBuckets;
	Kept.resize(Buckets);
	BlockOffsets.resize(Blocks);
	GroupBits.resize(Store.GetGroups().size());
	ParallelFor(GroupBits.size(), 1024, [&](size_t Begin, size_t End) {
		for (size_t I = Begin; I < End; ++I) { GroupBits[I] = Rule.Test(Store.GetGroups()[I].Center, Store.GetGroups()[I].Radius); }
	});
	const FPass Pass{Store, Rule, MakeKernelRule(Rule, glm::dvec3(0)), Missing, Store.HasMissing()};
	std::atomic<bool> bAnyChanged = false;
	ParallelFor(Blocks, 4, [&](size_t Begin, size_t End) {
		bool bHere = false;
		for (size_t Block = Begin; Block < End; ++Block) { BlockOffsets[Block] = CountBlock(Pass, Block, bHere); }
		if (bHere) { bAnyChanged.store(true, std::memory_order_relaxed); }
	});
	Total = 0;
	for (uint32_t& Offset : BlockOffsets) { Total += std::exchange(Offset, Total); }
	bChanged = bAnyChanged || SeenRevision != Store.GetRevision();
	SeenRevision = Store.GetRevision();
	return Total;
}

void FInstanceGather::WriteBlock(const FInstanceStore& Store, const glm::dvec3& Origin, size_t Block, FRTInstance* Out) const
{
	const FInstanceBinding* const Bindings = Store.GetBindings();
	const size_t End = std::min((Block + 1) * BlockBuckets, Kept.size());
	FRTInstance* Next = Out + BlockOffsets[Block];
	for (size_t I = Block * BlockBuckets; I < End; ++I)
	{
		const FKept& Here = Kept[I];
		if (Here.Written == 0) { continue; }
		const FInstanceBucket& Bucket = *Store.GetBucket(I);
		const glm::vec3 Offset = CellOffset(Bucket.Cell, Origin);
		for (uint64_t Left = Here.Written; Left != 0; Left &= Left - 1)
		{
			const auto Lane = static_cast<uint32_t>(std::countr_zero(Left));
			const uint32_t Bits = MaskBits((Here.Others >> Lane) & 1, (Here.Shadow >> Lane) & 1);
			WriteInstance(Next++, Bucket.Transform[Lane], Offset, Bucket.IndexAndMask[Lane] & Bits, Bindings[Bucket.Range[Lane]]);
		}
	}
#if defined(__SSE2__)
	_mm_sfence(); // streamed stores are ordered by nothing else
#endif
}

void FInstanceGather::Write(const FInstanceStore& Store, const glm::dvec3& Origin, FRTInstance* Out) const
{
	assert(SeenRevision == Store.GetRevision() && reinterpret_cast<uintptr_t>(Out) % 16 == 0);
	ParallelFor(BlockOffsets.size(), 4, [&](size_t Begin, size_t End) {
		for (size_t Block = Begin; Block < End; ++Block) { WriteBlock(Store, Origin, Block, Out); }
	});
}

} // namespace Lantern
