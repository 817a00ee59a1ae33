// TRefCounted: counts, the end of an object, and many threads.
#include "LanternRHICommon/RefCounted.h"

#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace Lantern
{
namespace
{

class FCountedObject : public TRefCounted<IRTRefCounted>
{
public:
	explicit FCountedObject(int& InDeaths) : Deaths(InDeaths) {}
	~FCountedObject() override { ++Deaths; }

private:
	int& Deaths;
};

/// Goes to a queue, as objects do for which the GPU is not done.
class FDeferredObject final : public FCountedObject
{
public:
	FDeferredObject(int& InDeaths, std::vector<FCountedObject*>& InRetired) : FCountedObject(InDeaths), Retired(InRetired) {}

private:
	void OnFinalRelease() override { Retired.push_back(this); }

	std::vector<FCountedObject*>& Retired;
};

TEST(RefCounted, DeletesItselfWithTheLastReference)
{
	int Deaths = 0;
	IRTRefCounted* Object = new FCountedObject(Deaths);
	EXPECT_EQ(Object->AddRef(), 2u);
	EXPECT_EQ(Object->Release(), 1u);
	EXPECT_EQ(Deaths, 0);
	EXPECT_EQ(Object->Release(), 0u);
	EXPECT_EQ(Deaths, 1);
}

TEST(RefCounted, ReferencesOfPointersAreCounted)
{
	int Deaths = 0;
	auto* Object = new FCountedObject(Deaths);
	EXPECT_EQ(Object->GetReferences(), 1u);
	{
		const TRTRef<FCountedObject> First(Object);
		const TRTRef<FCountedObject> Second = First;
		EXPECT_EQ(Object->GetReferences(), 3u);
	}
	EXPECT_EQ(Object->GetReferences(), 1u);
	Object->Release();
	EXPECT_EQ(Deaths, 1);
}

TEST(RefCounted, AnOverrideDecidesWhatTheLastReleaseDoes)
{
	int Deaths = 0;
	std::vector<FCountedObject*> Retired;
	auto* Object = new FDeferredObject(Deaths, Retired);
	EXPECT_EQ(Object->Release(), 0u);
	EXPECT_EQ(Deaths, 0) << "it waits";
	ASSERT_EQ(Retired.size(), 1u);
	delete Retired[0];
	EXPECT_EQ(Deaths, 1);
}

TEST(RefCounted, ManyThreadsReleaseOnce)
{
	int Deaths = 0;
	auto* Object = new FCountedObject(Deaths);
	std::vector<std::thread> Threads;
	for (int Thread = 0; Thread < 4; ++Thread)
	{
		Object->AddRef();
		Threads.emplace_back([Object] {
			for (int i = 0; i < 10'000; ++i)
			{
				Object->AddRef();
				Object->Release();
			}
			Object->Release();
		});
	}
	for (std::thread& Thread : Threads) { Thread.join(); }
	EXPECT_EQ(Deaths, 0);
	EXPECT_EQ(Object->Release(), 0u);
	EXPECT_EQ(Deaths, 1);
}

} // namespace
} // namespace Lantern
