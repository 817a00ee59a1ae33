// The pass that lists marked threads, against lists made on the CPU.
#include <random>
#include <ranges>

#include "RayQueueTypes.h"
#include "Support/RenderFixture.h"
#include "ThreadListTypes.h"

namespace Lantern
{

namespace
{
class FThreadListTest : public FRenderTest
{
protected:
	using FMarks = std::vector<bool>; ///< of threads, row by row

	static FMarks Mark(glm::uvec2 Size, double Chance)
	{
		std::mt19937 Random(Size.x + Size.y);
		FMarks Marks(size_t(Size.x) * Size.y);
		for (auto Thread : Marks) { Thread = std::generate_canonical<double, 32>(Random) < Chance; }
		return Marks;
	}

	/// Marked threads, tile after tile.
	static std::vector<uint32_t> Expect(glm::uvec2 Size, const FMarks& Marks)
	{
		std::vector<uint32_t> Out;
		for (const uint32_t Bit : std::views::iota(0u, CountBits(Size)))
		{
			const glm::uvec2 At = ThreadOf(Size, Bit);
			const uint32_t Thread = At.y * Size.x + At.x;
			if (At.x < Size.x && At.y < Size.y && Marks[Thread]) { Out.push_back(Thread); }
		}
		return Out;
	}

	static uint32_t CountBits(glm::uvec2 Size) { return (Size.x + 7) / 8 * ((Size.y + 7) / 8) * 64; }
	static glm::uvec2 ThreadOf(glm::uvec2 Size, uint32_t Bit)
	{
		const uint32_t Columns = (Size.x + 7) / 8, Tile = Bit / 64, Inside = Bit % 64;
		return glm::uvec2(Tile % Columns, Tile / Columns) * 8u + glm::uvec2(Inside % 8, Inside / 8);
	}

	struct FList
	{
		TRTRef<IRTBuffer> Buffer;
		uint32_t BitWords = 0;
		uint32_t* GetWords() const { return static_cast<uint32_t*>(Buffer->GetMapped()) + sizeof(FThreadList) / 4; }
		FThreadList& GetHeader() const { return *static_cast<FThreadList*>(Buffer->GetMapped()); }
		std::vector<uint32_t> Get() const
		{
			const uint32_t* const First = GetWords() + BitWords;
			return {First, First + GetHeader().Launch[0]};
		}
	};

	static FList Make(uint32_t Bits, uint32_t Entries)
	{
		FList List;
		List.BitWords = (Bits + 127) / 128 * 4;
		const uint64_t Words = sizeof(FThreadList) / 4 + List.BitWords + Entries;
		EXPECT_OK(GetDevice().CreateBuffer(
		    {Words * 4, ERTBufferUsage::Storage, ERTMemory::Readback, "Threads"}, List.Buffer.ReleaseAndGetAddress()));
		std::fill_n(static_cast<uint32_t*>(List.Buffer->GetMapped()), Words, 0u);
		List.GetHeader().BitWords = List.BitWords;
		return List;
	}

	static void Order(const FList& List, uint32_t Width, uint32_t GroupSize, const FList* From = nullptr)
	{
		IRTPipeline* Pipeline = nullptr;
		ASSERT_OK(GetEngine().GetRenderer().GetPipelines().Get({"Rays/OrderThreads.comp", ERTShaderStage::Compute}, Pipeline));
		FThreadOrderConstants C{};
		C.List = List.Buffer->GetDeviceAddress();
		C.From = From ? From->Buffer->GetDeviceAddress() : 0;
		C.Width = Width;
		C.GroupSize = GroupSize;
		const uint32_t PerGroup = THREAD_ORDER_GROUP_SIZE * 4;
		Dispatch(Pipeline, &C, sizeof(C), (List.BitWords + PerGroup - 1) / PerGroup, 1, List.Buffer.Get());
	}
};

TEST_F(FThreadListTest, MarkedThreadsAreListedTileByTile)
{
	for (const glm::uvec2 Size : {glm::uvec2(1, 1), glm::uvec2(131, 73), glm::uvec2(1000, 701)}) // the last one has 22 work groups
	{
		for (const double Chance : {0.0, 0.3, 1.0})
		{
			const FMarks Marks = Mark(Size, Chance);
			const FList List = Make(CountBits(Size), Size.x * Size.y);
			for (const uint32_t Bit : std::views::iota(0u, CountBits(Size)))
			{
				const glm::uvec2 At = ThreadOf(Size, Bit);
				if (At.x < Size.x && At.y < Size.y && Marks[At.y * Size.x + At.x]) { List.GetWords()[Bit / 32] |= 1u << Bit % 32; }
			}
			ASSERT_NO_FATAL_FAILURE(Order(List, Size.x, RAY_QUEUE_GROUP_SIZE));
			const std::vector<uint32_t> Expected = Expect(Size, Marks);
			EXPECT_EQ(List.Get(), Expected) << Size.x << " x " << Size.y << ", " << Chance;
			const size_t Row = RAY_QUEUE_GROUP_SIZE * RAY_QUEUE_ROW_GROUPS;
			EXPECT_EQ(List.GetHeader().Groups[1], (Expected.size() + Row - 1) / Row);
		}
	}
}

// A list of what has been marked among the entries of another one.
TEST_F(FThreadListTest, EntriesOfAnotherListAreTaken)
{
	const FList First = Make(128, 100), Second = Make(128, 100);
	First.GetHeader().Launch[0] = 100;
	for (uint32_t I = 0; I < 100; ++I) { First.GetWords()[First.BitWords + I] = 1000 - I; }
	for (const uint32_t Bit : {0u, 31u, 32u, 99u}) { Second.GetWords()[Bit / 32] |= 1u << Bit % 32; }
	ASSERT_NO_FATAL_FAILURE(Order(Second, 0, 1, &First));
	EXPECT_EQ(Second.Get(), (std::vector<uint32_t>{1000, 969, 968, 901}));
}

} // namespace
} // namespace Lantern
