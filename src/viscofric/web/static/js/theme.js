// Light or dark as chosen before, ahead of the first paint.
try {
  const theme = localStorage.getItem("viscofric.theme");
  if (theme === "light" || theme === "dark") document.documentElement.dataset.theme = theme;
} catch {
  // Without storage the system's choice holds.
}
