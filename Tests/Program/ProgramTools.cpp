#include "ProgramTools.h"

#include <csignal>
#include <cstring>
#include <sstream>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace Lantern
{

namespace
{

constexpr uid_t Nobody = 65534;

/// In the child: never returns.
[[noreturn]] void Execute(
    std::vector<char*>& Arguments, std::vector<char*>& Environment, const char* Out, const char* Err, const FProgramOptions& Options)
{
	const int OutFile = open(Out, O_WRONLY | O_CREAT | O_TRUNC, 0644);
	const int ErrFile = open(Err, O_WRONLY | O_CREAT | O_TRUNC, 0644);
	const int InFile = open("/dev/null", O_RDONLY);
	const bool bFiles = dup2(InFile, 0) >= 0 && dup2(OutFile, 1) >= 0 && dup2(ErrFile, 2) >= 0;
	const bool bFolder = Options.Folder.empty() || chdir(Options.Folder.c_str()) == 0;
	const bool bUser = !Options.bUnprivileged || geteuid() != 0 || (setgid(Nobody) == 0 && setuid(Nobody) == 0);
	if (bFiles && bFolder && bUser) { execve(Arguments.front(), Arguments.data(), Environment.data()); }
	_exit(127);
}

std::vector<std::string> MakeEnvironment(const FProgramOptions& Options)
{
	std::vector<std::string> Strings = {std::string("LANTERN_CACHE=") + LANTERN_TEST_CACHE};
	Strings.insert(Strings.end(), {"HOME=/nonexistent", "LC_ALL=C.UTF-8"});
	for (char** Variable = environ; *Variable; ++Variable)
	{
		const std::string_view Text = *Variable;
		const bool bKept = Text.substr(0, 3) == "VK_" || Text.substr(0, 3) == "LD_" || Text.substr(0, 5) == "PATH=" ||
		                   Text.find("SAN_OPTIONS=") != std::string_view::npos || Text.substr(0, 3) == "LP_" ||
		                   Text.substr(0, 4) == "MESA" || Text.substr(0, 15) == "XDG_CACHE_HOME=";
		if (bKept) { Strings.emplace_back(Text); }
	}
	for (const auto& [Name, Value] : Options.Environment)
	{
		const std::string Start = Name + "=";
		std::erase_if(Strings, [&](const std::string& Text) { return Text.rfind(Start, 0) == 0; });
		Strings.push_back(Start + Value);
	}
	return Strings;
}

std::vector<char*> MakePointers(std::vector<std::string>& Strings)
{
	std::vector<char*> Pointers;
	for (std::string& Text : Strings) { Pointers.push_back(Text.data()); }
	Pointers.push_back(nullptr);
	return Pointers;
}

} // namespace

std::vector<std::string> FProgramRun::GetMessages() const
{
	std::vector<std::string> Messages;
	std::istringstream Stream(Err);
	for (std::string Line; std::getline(Stream, Line);)
	{
		const auto Has = [&](const char* Text) { return Line.find(Text) != std::string::npos; };
		// "NAME (DRIVER)" of the device, and how long it took.
		const bool bDevice = Line.rfind("error", 0) != 0 && Line.rfind("warning", 0) != 0 && Line.back() == ')';
		// "frames:  50 %  ", which slow machines see and fast ones do not.
		const bool bProgress = Line.rfind("error", 0) != 0 && Line.rfind("warning", 0) != 0 && Has(" %  ");
		if (!bDevice && !bProgress && !Has("loaded in ") && !Has("Run with --help")) { Messages.push_back(Line); }
	}
	return Messages;
}

FProgramProcess::FProgramProcess(const std::vector<std::string>& Arguments, const FProgramOptions& Options)
    : Name(Arguments.empty() ? std::string() : Arguments.front())
{
	std::vector<std::string> Strings = {Options.Program.empty() ? LANTERN_PROGRAM : Options.Program};
	Strings.insert(Strings.end(), Arguments.begin(), Arguments.end());
	std::vector<std::string> Environment = MakeEnvironment(Options);
	std::vector<char*> ArgumentPointers = MakePointers(Strings), EnvironmentPointers = MakePointers(Environment);
	const std::string Kept = Files.GetPath() + "/out", Err = Files.GetPath() + "/err";
	const std::string Out = Options.StandardOutput.empty() ? Kept : Options.StandardOutput;
	Pid = fork();
	if (Pid == 0) { Execute(ArgumentPointers, EnvironmentPointers, Out.c_str(), Err.c_str(), Options); }
}

FProgramProcess::~FProgramProcess() { Kill(); }

bool FProgramProcess::IsRunning()
{
	if (Pid > 0 && waitpid(Pid, &WaitStatus, WNOHANG) == Pid) { Pid = -1; }
	return Pid > 0;
}

void FProgramProcess::Kill()
{
	if (IsRunning())
	{
		kill(Pid, SIGKILL);
		waitpid(Pid, &WaitStatus, 0);
		Pid = -1;
	}
}

std::string FProgramProcess::GetLastLine() const
{
	std::string Text = ReadFile(Files.GetPath() + "/err");
	Text.erase(Text.find_last_not_of("\r\n ") + 1);
	return Text.substr(Text.find_last_of("\r\n") + 1);
}

FProgramRun FProgramProcess::Wait()
{
	if (!WaitUntil(
	        "`lantern " + Name + "`", [&] { return !IsRunning(); }, {}, [&] { return GetLastLine(); }))
	{
		Kill();
	}
	FProgramRun Run;
	Run.Status = WIFEXITED(WaitStatus) ? WEXITSTATUS(WaitStatus) : 128 + WTERMSIG(WaitStatus);
	Run.Out = ReadFile(Files.GetPath() + "/out");
	Run.Err = ReadFile(Files.GetPath() + "/err");
	return Run;
}

FProgramRun RunProgram(const std::vector<std::string>& Arguments, const FProgramOptions& Options)
{
	return FProgramProcess(Arguments, Options).Wait();
}

std::string ReadFile(const std::string& Path)
{
	std::ifstream File(Path, std::ios::binary);
	return {std::istreambuf_iterator<char>(File), {}};
}

nlohmann::json ReadJson(const std::string& Path)
{
	nlohmann::json Json = nlohmann::json::parse(ReadFile(Path), nullptr, false);
	EXPECT_FALSE(Json.is_discarded()) << Path << " is no JSON:\n" << ReadFile(Path);
	return Json;
}

std::vector<std::string> ListFolder(const std::string& Path)
{
	std::vector<std::string> Names;
	for (const auto& Entry : std::filesystem::directory_iterator(Path)) { Names.push_back(Entry.path().filename().string()); }
	std::sort(Names.begin(), Names.end());
	return Names;
}

} // namespace Lantern
