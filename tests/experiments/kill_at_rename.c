/* Preloaded into programs: kills their whole process group when one renames a file to the name in KILL_AT_RENAME. */

#include <dlfcn.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>

int rename(const char* from, const char* to) {
  const char* name = getenv("KILL_AT_RENAME");
  const char* slash = strrchr(to, '/');
  if (name && strcmp(slash ? slash + 1 : to, name) == 0) kill(0, SIGKILL);
  return ((int (*)(const char*, const char*))dlsym(RTLD_NEXT, "rename"))(from, to);
}
