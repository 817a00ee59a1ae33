// The inner loops of gathering, in fp32 over arrays, for compilers to vectorise.
#pragma once

#include "LanternScene/Instances/InstanceStore.h"

namespace Lantern
{

/// FCullingRule in fp32. A radius is large enough on the screen up to the distance radius · Scale + Base: without a
/// limit the base is beyond the world.
struct FKernelRule
{
	float Eye[3], Forward[3];
	float Radius[2], InverseSine[2];
	float VisibleScale, VisibleBase, ShadowScale, ShadowBase;
};

/// What is certain of all objects of a bucket, whatever fp32 rounded. Nothing set: they are to be tested one by one.
enum EBucketClass : uint32_t
{
	BucketAllOthers = 1, ///< all seen by rays other than shadows'
	BucketNoOthers = 2,
	BucketAllShadow = 4,
	BucketNoShadow = 8,
};
/// Buckets First … First + Count − 1; Rule in the world.
void ClassifyBuckets(const FBucketBounds& Bounds, size_t First, size_t Count, const FKernelRule& Rule, uint32_t* OutClass);

/// One bit per object. Where Unsure, the others mean nothing.
struct FBucketMasks
{
	uint64_t Others = 0, Shadow = 0, Unsure = 0;
};
/// Rule relative to the bucket's cell. Slots that are not in use give anything.
FBucketMasks TestBucket(const FInstanceBucket& Bucket, const FKernelRule& Rule, float BucketExtent);

} // namespace Lantern
