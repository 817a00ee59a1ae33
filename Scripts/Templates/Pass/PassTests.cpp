// @TITLE@: both paths against the reference.
#include "SignalFixture.h"

namespace Lantern
{
namespace
{

class F@NAME@Test : public FSignalTest
{};

TEST_F(F@NAME@Test, EqualsTheReferenceOnBothPaths)
{
	ASSERT_TRUE(Load("ggx"));
	const FView View = MakeView(64, 36);
	const FImage Reference = TraceSignal(ESignal::@NAME@, View, 4);
	for (const char* Path : {"1", "2"})
	{
		SetVariable("r.RT.@NAME@.Path", Path);
		const FImage Picture = RenderSignal(ESignal::@NAME@, View);
		ASSERT_EQ(Picture.Pixels.size(), Reference.Pixels.size());
		// The G-buffer has 8 bits, the output fp16; pixels at edges may show another surface.
		size_t Wrong = 0;
		for (size_t I = 0; I < Picture.Pixels.size(); ++I) { Wrong += std::abs(Picture.Pixels[I] - Reference.Pixels[I]) > 0.004f ? 1 : 0; }
		EXPECT_LT(Wrong, Picture.Pixels.size() / 50) << "path " << Path;
	}
}

} // namespace
} // namespace Lantern
