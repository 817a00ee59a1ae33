// Reference files: what was written is read, what is not whole is not taken, and many may write at once.
#include "SignalReferenceFile.h"

#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <thread>

#include <gmock/gmock.h>
#include <unistd.h>

namespace Lantern
{

namespace
{
namespace fs = std::filesystem;

class FSignalReferenceFileTest : public ::testing::Test
{
protected:
	void SetUp() override
	{
		std::string Pattern = (fs::temp_directory_path() / "lantern-test-XXXXXX").string();
		ASSERT_NE(mkdtemp(Pattern.data()), nullptr);
		Folder = Pattern;
		Path = (Folder / "one.ref").string();
	}
	void TearDown() override { fs::remove_all(Folder); }

	static FSignalReference MakeReference(float Value = 0.25f)
	{
		FSignalReference Reference;
		Reference.A = FImage(3, 1, 1);
		Reference.B = FImage(3, 1, 1);
		for (size_t I = 0; I < Reference.A.Pixels.size(); ++I)
		{
			Reference.A.Pixels[I] = Value + static_cast<float>(I) * 1e-7f;
			Reference.B.Pixels[I] = std::nextafter(Value, 1e9f) * static_cast<float>(I);
		}
		Reference.Seconds = 1.5;
		return Reference;
	}
	bool Read(FSignalReference& Out, const FReferenceFileShape& Shape = {3, 1, 1}, const FContentHash& Key = {1, 2}) const
	{
		return ReadReferenceFile(Path, Key, Shape, Out);
	}

	fs::path Folder;
	std::string Path;
};

TEST_F(FSignalReferenceFileTest, RoundTripIsLossless)
{
	FSignalReference Reference = MakeReference(), Back;
	Reference.A.Pixels[0] = 1e30f;
	Reference.B.Pixels[1] = std::numeric_limits<float>::denorm_min();
	ASSERT_TRUE(WriteReferenceFile(Path, {1, 2}, Reference));
	ASSERT_TRUE(Read(Back));
	EXPECT_EQ(Back.A.Pixels, Reference.A.Pixels);
	EXPECT_EQ(Back.B.Pixels, Reference.B.Pixels);
	EXPECT_EQ(Back.Seconds, 1.5);
	EXPECT_EQ(Back.B.Width, 3u);
}

TEST_F(FSignalReferenceFileTest, AnotherKeyOrShapeIsNotTaken)
{
	FSignalReference Back;
	EXPECT_FALSE(Read(Back)) << "not there";
	ASSERT_TRUE(WriteReferenceFile(Path, {1, 2}, MakeReference()));
	EXPECT_FALSE(Read(Back, {3, 1, 1}, {1, 3}));
	EXPECT_FALSE(Read(Back, {1, 3, 1}));
	EXPECT_FALSE(Read(Back, {1, 1, 3}));
	EXPECT_TRUE(Read(Back));
}

TEST_F(FSignalReferenceFileTest, EveryDamageIsFound)
{
	ASSERT_TRUE(WriteReferenceFile(Path, {1, 2}, MakeReference()));
	std::string Bytes(static_cast<size_t>(fs::file_size(Path)), '\0');
	std::ifstream(Path, std::ios::binary).read(Bytes.data(), static_cast<std::streamsize>(Bytes.size()));
	const auto Store = [&](const std::string& Changed) {
		std::ofstream(Path, std::ios::binary | std::ios::trunc).write(Changed.data(), static_cast<std::streamsize>(Changed.size()));
	};
	FSignalReference Back;
	for (size_t I = 0; I < Bytes.size(); ++I)
	{
		std::string Changed = Bytes;
		Changed[I] = static_cast<char>(Changed[I] ^ 1);
		Store(Changed);
		ASSERT_FALSE(Read(Back)) << "byte " << I;
		ASSERT_TRUE(Back.A.IsEmpty());
	}
	for (const size_t Size : {size_t(0), size_t(10), size_t(64), Bytes.size() / 2, Bytes.size() - 1})
	{
		Store(Bytes.substr(0, Size));
		EXPECT_FALSE(Read(Back)) << "cut off at " << Size;
	}
	Store(Bytes + "x");
	EXPECT_FALSE(Read(Back)) << "too long";
	Store(Bytes);
	EXPECT_TRUE(Read(Back));
}

TEST_F(FSignalReferenceFileTest, ManyWriteAtOnce)
{
	std::atomic<int> Reads{0}, Failures{0};
	std::vector<std::thread> Threads;
	for (int Writer = 0; Writer < 4; ++Writer)
	{
		Threads.emplace_back([&, Writer] {
			for (int I = 0; I < 25; ++I) { Failures += WriteReferenceFile(Path, {1, 2}, MakeReference(float(Writer))) ? 0 : 1; }
		});
		Threads.emplace_back([&] {
			// Readers may run before the first writer does.
			for (int I = 0; I < 100 || (Reads == 0 && Failures == 0); ++I)
			{
				FSignalReference Back;
				const bool bThere = fs::exists(Path);
				if (Read(Back)) { ++Reads; }
				else { Failures += bThere ? 1 : 0; } // once there, it is whole at any time
			}
		});
	}
	for (std::thread& Thread : Threads) { Thread.join(); }
	EXPECT_EQ(Failures, 0);
	EXPECT_GT(Reads, 0);
	EXPECT_EQ(std::distance(fs::directory_iterator(Folder), fs::directory_iterator()), 1) << "nothing temporary is left";
}

} // namespace
} // namespace Lantern
