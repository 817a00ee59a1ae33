// Inner loops of gathering: fp32 over arrays, so that compilers vectorise them.
#pragma once

#include "LanternScene/Instances/InstanceStore.h"

namespace Lantern
{

/// FCullingRule in fp32. A radius is large enough on the screen up to the distance radius · Scale + Base. Without a limit,
/// Base is beyond the world.
struct FKernelRule
{
	float Eye[3], Forward[3];
	float Radius[2], InverseSine[2];
	float VisibleScale, VisibleBase, ShadowScale, ShadowBase;
};

/// What is certain of all objects of a bucket, whatever fp32 rounded. If no bit is set, each object must be tested.
enum EBucketClass : uint32_t
{
	BucketAllOthers = 1, ///< rays other than shadow rays see all of them
	BucketNoOthers = 2,
	BucketAllShadow = 4,
	BucketNoShadow = 8,
};
/// Classifies the buckets First … First + Count − 1. Rule is in world coordinates.
void ClassifyBuckets(const FBucketBounds& Bounds, size_t First, size_t Count, const FKernelRule& Rule, uint32_t* OutClass);

/// One bit for each lane. If Unsure is set, the other two mean nothing.
struct FBucketMasks
{
	uint64_t Others = 0, Shadow = 0, Unsure = 0;
};
/// Tests every object of a bucket. Rule is relative to the bucket's cell. Bits of unused lanes are undefined.
FBucketMasks TestBucket(const FInstanceBucket& Bucket, const FKernelRule& Rule, float BucketExtent);

} // namespace Lantern
