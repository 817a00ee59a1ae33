// Lists of threads: empty ones, and the pass that fills them with what has been marked.
#include "Rays/ThreadList.h"

#include "PassTools.h"

namespace Lantern
{

namespace
{
static_assert(RAY_QUEUE_GROUP_SIZE == THREAD_TILE * THREAD_TILE, "MarkThreads.glsl: a group has the bits of a tile");

uint32_t CountBitWords(uint32_t Width, uint32_t Height)
{
	const uint64_t Bits = uint64_t(DivideUp(Width, THREAD_TILE)) * DivideUp(Height, THREAD_TILE) * THREAD_TILE * THREAD_TILE;
	constexpr uint64_t Whole = THREAD_ORDER_BITS;
	return static_cast<uint32_t>((Bits + Whole - 1) / Whole * (Whole / 32));
}
} // namespace

FShaderSource MakeThreadOrderSource() { return MakeComputeSource("Rays/OrderThreads.comp"); }

FThreadMarks AddThreadMarks(FFrameContext& Context, uint32_t Width, uint32_t Height, std::string Name)
{
	constexpr uint64_t Word = sizeof(uint32_t);
	const uint32_t BitWords = CountBitWords(Width, Height);
	const uint64_t Bytes = sizeof(FThreadList) + (BitWords + uint64_t(Width) * Height) * Word;
	FThreadMarks Marks{{}, std::move(Name), Width, Height};
	const FGraphBuffer List = Context.Graph.CreateBuffer({Bytes, ERTBufferUsage::Indirect | ERTBufferUsage::CopyDest}, Marks.Name.c_str());
	Context.Graph.AddPass(Marks.Name.c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Write(List, ERTAccess::CopyWrite);
		Context.Tokens.LeaveAlone(Builder);
		return [=](FPassContext& Pass) {
			constexpr uint64_t Groups = offsetof(FThreadList, Groups), Launch = offsetof(FThreadList, Launch);
			const auto Fill = [&](uint64_t Offset, uint64_t Size, uint32_t Value) {
				Pass.Commands().FillBuffer(Pass.GetBuffer(List), Offset, Size, Value);
			};
			Fill(Groups, Word, RAY_QUEUE_ROW_GROUPS);
			Fill(Groups + Word, Word, 0);
			Fill(Groups + 2 * Word, Word, 1);
			Fill(Launch, Word, 0);
			Fill(Launch + Word, 2 * Word, 1);
			Fill(offsetof(FThreadList, BitWords), Word, BitWords);
			Fill(sizeof(FThreadList), BitWords * Word, 0);
		};
	});
	Marks.List = List;
	return Marks;
}

void AddThreadOrder(FFrameContext& Context, const FThreadMarks& Marks, FGraphBuffer From, uint32_t GroupSize)
{
	IRTPipeline* const Pipeline = RequireCompute(Context, MakeThreadOrderSource());
	Context.Graph.AddPass((Marks.Name + "Order").c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
		MarkThreads(Builder, Marks.List);
		if (From.IsValid()) { Builder.Read(From, ERTAccess::ShaderRead); }
		Context.Tokens.LeaveAlone(Builder);
		Builder.AllowAsync();
		return [=, List = Marks.List, Width = Marks.Width, Height = Marks.Height](FPassContext& Pass) {
			FThreadOrderConstants C{};
			C.List = GetAddress(Pass, List);
			C.From = GetAddress(Pass, From);
			C.Width = Width;
			C.GroupSize = GroupSize;
			Dispatch2D(Pass, Pipeline, C, CountBitWords(Width, Height) * 32 / THREAD_ORDER_BITS, 1, THREAD_ORDER_GROUP_SIZE);
		};
	});
}

} // namespace Lantern
