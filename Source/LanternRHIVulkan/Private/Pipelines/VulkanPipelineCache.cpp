// FVulkanPipelineCache: reads, checks and writes the file.
#include "Pipelines/VulkanPipelineCache.h"

#include "Device/VulkanStatus.h"

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>

#include <unistd.h>

namespace Lantern
{

namespace
{

/// Stands before the driver's data, which some drivers do not check against damage.
struct FHeader
{
	char Magic[8];
	uint64_t DataBytes;
	uint64_t Checksum;
	uint32_t VendorId;
	uint32_t DeviceId;
	uint32_t DriverVersion;
	uint32_t Reserved;
	uint8_t Uuid[VK_UUID_SIZE];
};
static_assert(sizeof(FHeader) == 56, "written to files as it is");

constexpr char Magic[8] = {'L', 'N', 'P', 'S', 'O', '0', '1', '\n'};

/// FNV-1a, 64 bits.
uint64_t HashBytes(const std::vector<char>& Data)
{
	uint64_t Hash = 14695981039346656037ull;
	for (const char Byte : Data) { Hash = (Hash ^ static_cast<uint8_t>(Byte)) * 1099511628211ull; }
	return Hash;
}

FHeader MakeHeader(const FVulkanProbe& Probe)
{
	FHeader Header{};
	memcpy(Header.Magic, Magic, sizeof(Magic));
	Header.VendorId = Probe.VendorId;
	Header.DeviceId = Probe.DeviceId;
	Header.DriverVersion = Probe.DriverVersion;
	memcpy(Header.Uuid, Probe.PipelineCacheUuid, VK_UUID_SIZE);
	return Header;
}

/// Returns why the file cannot be used, or null.
const char* ReadCacheFile(FILE* Stream, const FHeader& Expected, std::vector<char>& OutData)
{
	FHeader Header{};
	if (fread(&Header, sizeof(Header), 1, Stream) != 1 || memcmp(Header.Magic, Magic, sizeof(Magic)) != 0)
	{
		return "is no pipeline cache";
	}
	if (Header.VendorId != Expected.VendorId || Header.DeviceId != Expected.DeviceId || Header.DriverVersion != Expected.DriverVersion ||
	    memcmp(Header.Uuid, Expected.Uuid, VK_UUID_SIZE) != 0)
	{
		return "is another driver's or device's";
	}
	char Chunk[65536];
	while (OutData.size() <= Header.DataBytes)
	{
		const size_t Count = fread(Chunk, 1, sizeof(Chunk), Stream);
		if (Count == 0) { break; }
		OutData.insert(OutData.end(), Chunk, Chunk + Count);
	}
	if (OutData.size() != Header.DataBytes || HashBytes(OutData) != Header.Checksum) { return "is damaged"; }
	return nullptr;
}

constexpr char TemporarySuffix[] = ".XXXXXX"; // as mkstemp wants it

/// A process that was killed while it wrote has left a file behind. No write takes a day.
void RemoveLeftOvers(const std::string& File)
{
	namespace fs = std::filesystem;
	const fs::path Path(File);
	const std::string Prefix = Path.filename().string() + '.';
	std::error_code Code;
	for (fs::directory_iterator It(Path.has_parent_path() ? Path.parent_path() : ".", Code), End; !Code && It != End; It.increment(Code))
	{
		const std::string Name = It->path().filename().string();
		const bool bTemporary = Name.size() == Prefix.size() + strlen(TemporarySuffix) - 1 && Name.compare(0, Prefix.size(), Prefix) == 0;
		std::error_code Gone;
		const fs::file_time_type Written = bTemporary ? It->last_write_time(Gone) : fs::file_time_type();
		const bool bOld = fs::file_time_type::clock::now() - Written > std::chrono::hours(24);
		if (bTemporary && !Gone && bOld) { fs::remove(It->path(), Gone); }
	}
}

} // namespace

VkResult FVulkanPipelineCache::Create(
    VkDevice InDevice, const FVulkanDeviceApi& InApi, const FVulkanProbe& Probe, char* OutMessage, size_t MessageSize)
{
	Device = InDevice;
	Api = &InApi;
	const FHeader Own = MakeHeader(Probe);
	Prefix.assign(reinterpret_cast<const char*>(&Own), reinterpret_cast<const char*>(&Own) + sizeof(Own));
	std::vector<char> Data;
	if (FILE* Stream = File.empty() ? nullptr : fopen(File.c_str(), "rb"))
	{
		const char* Problem = ReadCacheFile(Stream, Own, Data);
		fclose(Stream);
		if (Problem)
		{
			snprintf(OutMessage, MessageSize, "pipeline cache %s %s: discarded", Show(File).c_str(), Problem);
			Data.clear();
		}
	}
	VkPipelineCacheCreateInfo Info{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
	Info.initialDataSize = Data.size();
	Info.pInitialData = Data.data();
	const VkResult Result = Api->CreatePipelineCache(Device, &Info, nullptr, &Handle);
	if (Result == VK_SUCCESS || Data.empty()) { return Result; }
	snprintf(OutMessage, MessageSize, "pipeline cache %s is refused by the driver (%s): discarded", Show(File).c_str(), ToString(Result));
	Info.initialDataSize = 0;
	return Api->CreatePipelineCache(Device, &Info, nullptr, &Handle);
}

void FVulkanPipelineCache::Destroy()
{
	if (Handle)
	{
		Api->DestroyPipelineCache(Device, Handle, nullptr);
		Handle = VK_NULL_HANDLE;
	}
}

FRTStatus FVulkanPipelineCache::Save()
{
	if (File.empty() || !Handle) { return {}; }
	std::scoped_lock Lock(Mutex);
	size_t Size = 0;
	VkResult Result = Api->GetPipelineCacheData(Device, Handle, &Size, nullptr);
	std::vector<char> Data(Size);
	Result = Result ? Result : Api->GetPipelineCacheData(Device, Handle, &Size, Data.data());
	if (Result != VK_SUCCESS && Result != VK_INCOMPLETE) { return MakeStatus(Result, "vkGetPipelineCacheData", File.c_str()); }
	Data.resize(Size);
	FHeader Header;
	memcpy(&Header, Prefix.data(), sizeof(Header));
	Header.DataBytes = Size;
	Header.Checksum = HashBytes(Data);

	// The name is unique: other processes, and other devices of this one, may be writing the file too.
	std::string Temporary = File + TemporarySuffix;
	const int Descriptor = mkstemp(Temporary.data());
	int Reason = errno;
	if (Descriptor < 0)
	{
		return FRTStatus::Error(ERTResult::IoError, "pipeline cache %s was not written: %s", Show(File).c_str(), strerror(Reason));
	}
	FILE* Stream = fdopen(Descriptor, "wb");
	bool bWritten = Stream && fwrite(&Header, sizeof(Header), 1, Stream) == 1 && (Size == 0 || fwrite(Data.data(), Size, 1, Stream) == 1);
	Reason = errno;
	if ((Stream ? fclose(Stream) : close(Descriptor)) != 0)
	{
		bWritten = false;
		Reason = errno;
	}
	if (bWritten && rename(Temporary.c_str(), File.c_str()) != 0)
	{
		bWritten = false;
		Reason = errno;
	}
	if (!bWritten)
	{
		remove(Temporary.c_str());
		return FRTStatus::Error(ERTResult::IoError, "pipeline cache %s was not written: %s", Show(File).c_str(), strerror(Reason));
	}
	RemoveLeftOvers(File);
	return {};
}

} // namespace Lantern
